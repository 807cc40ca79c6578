#include "water/pass/water_pass.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "embedded/stroke.frag.h"
#include "embedded/stroke.vert.h"
#include "embedded/surface.frag.h"
#include "embedded/surface.vert.h"
#include "pipeline/frame/error.h"

namespace rinkaku::water {
namespace {

void attribute(GLuint array, GLuint location, GLint size, GLenum type, GLboolean normalised, std::size_t offset) {
  glEnableVertexArrayAttrib(array, location);
  glVertexArrayAttribFormat(array, location, size, type, normalised, static_cast<GLuint>(offset));
  glVertexArrayAttribBinding(array, location, 0);
}

gl::Program program(std::string_view name, std::string_view vertex, std::string_view fragment,
                    std::span<const std::string_view> defines) {
  const std::string_view vertex_parts[] = {vertex}, fragment_parts[] = {fragment};
  return gl::Program(name, defines, vertex_parts, fragment_parts);
}

// The pixels of the picture within which a surface lies, cut off a little before the eye.
passes::PixelRect bounds(const Surface& surface, const passes::View& view) {
  constexpr double nearest_m = 0.01;
  glm::dvec2 least(1e9), most(-1e9);
  const auto take = [&](const glm::dvec3& c) {
    const glm::dvec2 p = to_pixels(view.camera, {c.x / c.z, c.y / c.z});
    least = {std::min(least.x, p.x), std::min(least.y, p.y)};
    most = {std::max(most.x, p.x), std::max(most.y, p.y)};
  };
  const auto ring = surface.outline();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec3 a = view.camera_from_world * surface.to_world(ring[i]);
    const glm::dvec3 b = view.camera_from_world * surface.to_world(ring[(i + 1) % ring.size()]);
    if (a.z >= nearest_m) take(a);
    if ((a.z < nearest_m) != (b.z < nearest_m)) take(a + (b - a) * ((nearest_m - a.z) / (b.z - a.z)));
  }
  if (most.x < least.x) return {};
  least = glm::max(least, glm::dvec2(-1e6)), most = glm::min(most, glm::dvec2(1e6));
  const int x = static_cast<int>(std::floor(least.x)) - 2, y = static_cast<int>(std::floor(least.y)) - 2;
  return {x, y, static_cast<int>(std::ceil(most.x)) + 3 - x, static_cast<int>(std::ceil(most.y)) + 3 - y};
}

passes::PixelRect bounds(std::span<const Stroke> strokes) {
  passes::PixelRect rect;
  for (const Stroke& s : strokes) {
    const float reach = glm::length(s.half_px) + s.half_width_px + 1;
    if (!(std::abs(s.middle_px.x) < 1e6f && std::abs(s.middle_px.y) < 1e6f)) continue;
    const int x = static_cast<int>(std::floor(s.middle_px.x - reach)),
              y = static_cast<int>(std::floor(s.middle_px.y - reach));
    const int side = static_cast<int>(std::ceil(2 * reach)) + 2;
    rect = united(rect, {x, y, side, side});
  }
  return rect;
}

}  // namespace

gl::TextureHandle WaterPass::upload(const BrushSheet& sheet) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &name);
  gl::TextureHandle texture(name);
  // Four channels though two are used: GL in software reads them faster.
  glTextureStorage3D(name, 1, GL_RGBA8, sheet.width_px, sheet.height_px, sheet.layers);
  if (glGetError() != GL_NO_ERROR) throw runtime_failure("OpenGL", "there is no memory for the water's brushes");
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage3D(name, 0, 0, 0, 0, sheet.width_px, sheet.height_px, sheet.layers, GL_RG, GL_UNSIGNED_BYTE,
                      sheet.texels.data());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

WaterPass::StrokeProgram WaterPass::stroke_program(int own_brushes) {
  static constexpr std::string_view counts[] = {"OWN_BRUSHES 1", "OWN_BRUSHES 2", "OWN_BRUSHES 3", "OWN_BRUSHES 4"};
  StrokeProgram p;
  p.program = program("stroke", embedded::stroke_vert, embedded::stroke_frag,
                      own_brushes > 0 ? std::span(counts + own_brushes - 1, 1) : std::span<const std::string_view>());
  p.near_m = p.program.uniform("near_m");
  p.rect_px = p.program.uniform("rect_px");
  p.size_px = p.program.uniform("size_px");
  return p;
}

WaterPass::WaterPass(const BrushSheet& lines, const BrushSheet& drops, const BrushSheet& own)
    : lines_(upload(lines)),
      drops_(upload(drops)),
      line_program_(stroke_program(0)),
      surface_program_(program("water", embedded::surface_vert, embedded::surface_frag, {})),
      stroke_array_(gl::make_vertex_array()),
      surface_array_(gl::make_vertex_array()) {
  if (own.layers > 0) {
    own_ = upload(own);
    own_program_ = stroke_program(std::min(own.layers, 4));
  }
  const GLuint strokes = stroke_array_.name();
  attribute(strokes, 0, 4, GL_FLOAT, GL_FALSE, offsetof(Stroke, middle_px));
  attribute(strokes, 1, 3, GL_FLOAT, GL_FALSE, offsetof(Stroke, half_width_px));
  attribute(strokes, 2, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Stroke, colour));
  attribute(strokes, 3, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Stroke, blend));
  glVertexArrayBindingDivisor(strokes, 0, 1);
  attribute(surface_array_.name(), 0, 2, GL_FLOAT, GL_FALSE, offsetof(Corner, at));
  attribute(surface_array_.name(), 1, 2, GL_FLOAT, GL_FALSE, offsetof(Corner, outwards));
  clip_from_surface_ = surface_program_.uniform("clip_from_surface");
  ground_opacity_ = surface_program_.uniform("ground_opacity");
  ground_place_ = surface_program_.uniform("ground_place");
  glProgramUniform1i(surface_program_.name(), surface_program_.uniform("painting"), 0);
  glProgramUniform1i(surface_program_.name(), surface_program_.uniform("ground"), 1);
  viewport_px_ = surface_program_.uniform("viewport_px");
}

void WaterPass::show(std::span<const PaintedSurface> surfaces, std::span<const Stroke> over,
                     std::span<const Stroke> drops) {
  shown_.assign(surfaces.begin(), surfaces.end());
  over_ = over, drops_shown_ = drops;
  while (targets_.size() < shown_.size())
    targets_.emplace_back(std::vector<GLenum>{GL_RGBA8}, gl::TextureTarget::Depth::None);
  if (grounds_.size() < shown_.size()) grounds_.resize(shown_.size());
}

passes::PixelRect WaterPass::look(const passes::View& view, const passes::PixelRect& picture) {
  passes::PixelRect rect = united(bounds(over_), bounds(drops_shown_));
  for (const PaintedSurface& s : shown_) {
    if (!s.strokes.empty()) rect = united(rect, bounds(*s.surface, view));
  }
  rect = intersection(rect, picture);
  return rect.empty() ? passes::PixelRect{} : rect;
}

void WaterPass::draw_strokes(std::span<const Stroke> strokes, const StrokeProgram& with, const gl::TextureHandle& sheet,
                             const passes::PixelRect& rect, double near_m) {
  if (strokes.empty()) return;
  stroke_buffer_.write(std::as_bytes(strokes));
  glVertexArrayVertexBuffer(stroke_array_.name(), 0, stroke_buffer_.name(), 0, sizeof(Stroke));
  glUseProgram(with.program.name());
  glUniform2f(with.rect_px, static_cast<float>(rect.x_px), static_cast<float>(rect.y_px));
  glUniform2f(with.size_px, static_cast<float>(rect.width_px), static_cast<float>(rect.height_px));
  glUniform1f(with.near_m, static_cast<float>(near_m));
  glBindTextureUnit(0, sheet.name());
  glBindVertexArray(stroke_array_.name());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(strokes.size()));
}

void WaterPass::upload_ground(const ReferencePicture& picture, Ground& ground) {
  if (ground.version == picture.version() && ground.texture) return;
  ground.version = picture.version();
  if (!ground.texture || ground.width_px != picture.width_px() || ground.height_px != picture.height_px()) {
    ground.width_px = picture.width_px(), ground.height_px = picture.height_px();
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &name);
    ground.texture = gl::TextureHandle(name);
    glTextureStorage2D(name, 1, GL_RGBA8, ground.width_px, ground.height_px);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  }
  ground_texels_.clear();
  for (const glm::vec3& c : picture.samples()) {
    for (int i = 0; i < 3; ++i) ground_texels_.push_back(static_cast<std::uint8_t>(std::lround(255 * c[i])));
    ground_texels_.push_back(255);
  }
  glTextureSubImage2D(ground.texture.name(), 0, 0, 0, ground.width_px, ground.height_px, GL_RGBA, GL_UNSIGNED_BYTE,
                      ground_texels_.data());
}

void WaterPass::draw_aside(const passes::View&, const passes::PixelRect& rect) {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    targets_[i].begin(rect.width_px, rect.height_px);
    if (own_) {
      draw_strokes(shown_[i].strokes, own_program_, own_, rect, passes::near_m);
    } else {
      draw_strokes(shown_[i].strokes, line_program_, lines_, rect, passes::near_m);
    }
  }
}

void WaterPass::draw(const passes::View& view, const passes::PixelRect& rect) {
  glUseProgram(surface_program_.name());
  glUniform2f(viewport_px_, static_cast<float>(rect.width_px), static_cast<float>(rect.height_px));
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    if (shown_[i].strokes.empty()) continue;
    const Surface& surface = *shown_[i].surface;
    corners_.clear();
    for (const glm::dvec2& p : surface.triangles()) corners_.push_back({glm::vec2(p), {}});
    for (const BorderEdge& e : surface.edges()) {
      const glm::dvec2 d = e.b - e.a;
      const glm::vec2 a(e.a), b(e.b), out(glm::normalize(glm::dvec2(d.y, -d.x)));
      corners_.insert(corners_.end(), {{a, {}}, {b, {}}, {a, out}, {a, out}, {b, {}}, {b, out}});
    }
    surface_buffer_.write(std::as_bytes(std::span(corners_)));
    glVertexArrayVertexBuffer(surface_array_.name(), 0, surface_buffer_.name(), 0, sizeof(Corner));
    glm::dmat4 world_from_surface(1.0);
    const glm::dvec3 origin = surface.to_world({0, 0});
    world_from_surface[0] = glm::dvec4(surface.to_world({1, 0}) - origin, 0);
    world_from_surface[1] = glm::dvec4(surface.to_world({0, 1}) - origin, 0);
    world_from_surface[2] = glm::dvec4(surface.normal(), 0);
    world_from_surface[3] = glm::dvec4(origin, 1);
    const glm::mat4 clip(passes::clip_from_view(view, rect) * to_matrix(view.camera_from_world) * world_from_surface);
    glUniformMatrix4fv(clip_from_surface_, 1, GL_FALSE, glm::value_ptr(clip));
    glBindTextureUnit(0, targets_[i].colour(0));
    const ReferencePicture* ground = shown_[i].ground;
    const bool grounded = ground != nullptr && !ground->empty() && shown_[i].ground_opacity > 0;
    glUniform1f(ground_opacity_, grounded ? shown_[i].ground_opacity : 0);
    if (grounded) {
      upload_ground(*ground, grounds_[i]);
      // From a pixel of the target to the picture's own coordinates; texel centres lie at its pixels.
      const auto step = static_cast<float>(ground->step_px());
      const float w = step * static_cast<float>(ground->width_px()), h = step * static_cast<float>(ground->height_px());
      glUniform4f(ground_place_, (static_cast<float>(rect.x_px) - 0.5f + step / 2) / w,
                  (static_cast<float>(rect.y_px) - 0.5f + step / 2) / h, 1 / w, 1 / h);
      glBindTextureUnit(1, grounds_[i].texture.name());
    }
    glBindVertexArray(surface_array_.name());
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners_.size()));
  }
}

void WaterPass::draw_over(const passes::View& view, const passes::PixelRect& rect) {
  draw_strokes(over_, line_program_, lines_, rect, view.nearest_m);
  draw_strokes(drops_shown_, line_program_, drops_, rect, view.nearest_m);
}

}  // namespace rinkaku::water
