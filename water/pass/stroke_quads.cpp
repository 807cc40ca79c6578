#include "water/pass/stroke_quads.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include <glm/geometric.hpp>

#include "embedded/stroke.frag.h"
#include "embedded/stroke.vert.h"
#include "pipeline/frame/error.h"
#include "pipeline/gl/vertex_attribute.h"

namespace rinkaku::water {
namespace {

gl::Program stroke_program(int own_brushes) {
  static constexpr std::string_view counts[] = {"OWN_BRUSHES 1", "OWN_BRUSHES 2", "OWN_BRUSHES 3", "OWN_BRUSHES 4"};
  const std::string_view vertex[] = {embedded::stroke_vert}, fragment[] = {embedded::stroke_frag};
  return gl::Program("stroke",
                     own_brushes > 0 ? std::span(counts + own_brushes - 1, 1) : std::span<const std::string_view>(),
                     vertex, fragment);
}

}  // namespace

Brushes::Brushes(const BrushSheet& sheet) : atlas_(brush_atlas(sheet)) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &name);
  texture_ = gl::TextureHandle(name);
  // Four channels though two are used: GL in software reads them faster.
  glTextureStorage2D(name, 1, GL_RGBA8, atlas_.width_px, atlas_.height_px);
  if (glGetError() != GL_NO_ERROR) throw runtime_failure("OpenGL", "there is no memory for the water's brushes");
  glTextureSubImage2D(name, 0, 0, 0, atlas_.width_px, atlas_.height_px, GL_RGBA, GL_UNSIGNED_BYTE,
                      atlas_.texels.data());
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

StrokeQuads::StrokeQuads(int own_brushes) : program_(stroke_program(own_brushes)), array_(gl::make_vertex_array()) {
  rect_px_ = program_.uniform("rect_px");
  size_px_ = program_.uniform("size_px");
  near_m_ = program_.uniform("near_m");
  const GLuint array = array_.name();
  gl::set_attribute(array, 0, {3, GL_FLOAT, GL_FALSE, offsetof(Corner, place)});
  gl::set_attribute(array, 1, {2, GL_FLOAT, GL_FALSE, offsetof(Corner, brush)});
  gl::set_attribute(array, 2, {4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Corner, colour)});
  if (own_brushes == 0) return;
  gl::set_attribute(array, 3, {4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Corner, blend)});
  gl::set_attribute(array, 4, {1, GL_FLOAT, GL_FALSE, offsetof(Corner, next_brush)});
}

void StrokeQuads::add_corners(const Stroke& stroke, const BrushAtlas& atlas) {
  const float half_length = glm::length(stroke.half_px);
  const BrushAtlas::Level& level = atlas.level_for(2 * half_length, 2 * stroke.half_width_px);
  const glm::vec2 size(level.width_px, level.height_px);
  // Half a texel more on each side: there the paint has faded out.
  const glm::vec2 more = (size + 1.0f) / size;
  const glm::vec2 along = stroke.half_px * more.x;
  const glm::vec2 across =
      glm::vec2(-stroke.half_px.y, stroke.half_px.x) * (stroke.half_width_px * more.y / std::max(half_length, 1e-6f));
  const glm::vec2 texel(1.0f / static_cast<float>(atlas.width_px), 1.0f / static_cast<float>(atlas.height_px));
  const glm::vec2 first = glm::vec2(level.left_px + static_cast<int>(stroke.brush) * level.step_px, level.top_px);
  const glm::vec2 least = (first - 0.5f) * texel, most = (first + size + 0.5f) * texel;
  Corner corner;
  corner.colour = stroke.colour, corner.blend = stroke.blend;
  corner.next_brush = static_cast<float>(level.step_px) * texel.x;
  // Along the quad's diagonal both of its triangles are drawn into the same blocks of pixels, as software does it: the
  // diagonal that lies more upright or level meets fewer.
  const glm::vec2 rising = glm::abs(along + across), falling = glm::abs(along - across);
  for (const int i : rising.x + rising.y < falling.x + falling.y ? std::array{1, 3, 0, 2} : std::array{0, 1, 2, 3}) {
    const bool right = (i & 1) != 0, top = (i & 2) != 0;
    corner.place = glm::vec3(stroke.middle_px + (right ? along : -along) + (top ? across : -across), stroke.depth_m);
    corner.brush = {right ? most.x : least.x, top ? most.y : least.y};
    corners_.push_back(corner);
  }
}

void StrokeQuads::number_corners(std::size_t strokes) {
  if (strokes <= numbered_) return;
  numbered_ = strokes + strokes / 4;
  std::vector<std::uint32_t> numbers;
  numbers.reserve(6 * numbered_);
  for (std::size_t i = 0; i < numbered_; ++i) {
    const auto first = static_cast<std::uint32_t>(4 * i);
    numbers.insert(numbers.end(), {first, first + 1, first + 2, first + 2, first + 1, first + 3});
  }
  numbers_ = gl::StaticBuffer(std::as_bytes(std::span(numbers)));
  glVertexArrayElementBuffer(array_.name(), numbers_.name());
}

void StrokeQuads::draw(std::span<const Stroke> strokes, const Brushes& brushes, const PixelRect& rect, double near_m) {
  if (strokes.empty()) return;
  corners_.clear();
  for (const Stroke& stroke : strokes) add_corners(stroke, brushes.atlas());
  number_corners(strokes.size());
  buffer_.write(std::as_bytes(std::span(corners_)));
  glVertexArrayVertexBuffer(array_.name(), 0, buffer_.name(), 0, sizeof(Corner));
  glUseProgram(program_.name());
  glUniform2f(rect_px_, static_cast<float>(rect.x_px), static_cast<float>(rect.y_px));
  glUniform2f(size_px_, static_cast<float>(rect.width_px), static_cast<float>(rect.height_px));
  glUniform1f(near_m_, static_cast<float>(near_m));
  glBindTextureUnit(0, brushes.texture());
  glBindVertexArray(array_.name());
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(6 * strokes.size()), GL_UNSIGNED_INT, nullptr);
}

}  // namespace rinkaku::water
