#include "water/pass/water_pass.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "embedded/surface.frag.h"
#include "embedded/surface.vert.h"
#include "pipeline/gl/vertex_attribute.h"

namespace rinkaku::water {
namespace {

gl::Program surface_program() {
  const std::string_view vertex[] = {embedded::surface_vert}, fragment[] = {embedded::surface_frag};
  return gl::Program("water", {}, vertex, fragment);
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

WaterPass::WaterPass(const BrushSheet& lines, const BrushSheet& drops, const BrushSheet& own)
    : lines_(lines),
      drops_(drops),
      quads_(0),
      surface_program_(surface_program()),
      surface_array_(gl::make_vertex_array()) {
  if (own.layers > 0) {
    own_.emplace(own);
    own_quads_.emplace(std::min(own.layers, 4));
  }
  gl::set_attribute(surface_array_.name(), 0, {2, GL_FLOAT, GL_FALSE, offsetof(Corner, at)});
  gl::set_attribute(surface_array_.name(), 1, {2, GL_FLOAT, GL_FALSE, offsetof(Corner, outwards)});
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

void WaterPass::upload_ground(const ReferencePicture& picture, Ground& ground) {
  if (ground.of == &picture && ground.version == picture.version() && ground.texture) return;
  ground.of = &picture, ground.version = picture.version();
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
      own_quads_->draw(shown_[i].strokes, *own_, rect, passes::near_m);
    } else {
      quads_.draw(shown_[i].strokes, lines_, rect, passes::near_m);
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
  quads_.draw(over_, lines_, rect, view.nearest_m);
  quads_.draw(drops_shown_, drops_, rect, view.nearest_m);
}

}  // namespace rinkaku::water
