#include "pipeline/passes/toon/coarse_colour.h"

#include "embedded/coarse_colour.glsl.h"

namespace rinkaku::passes {
namespace {

constexpr GLuint colour_unit = 1, depth_unit = 2, band_colour_unit = 3, band_depth_unit = 4;

int floored(int value, int step) {
  const int rest = value % step;
  return value - (rest < 0 ? rest + step : rest);
}

// The pixels whose texels the pixels of `rect` look up.
PixelRect on_grid(const PixelRect& rect, int step) {
  const int left = floored(rect.x_px - step, step), top = floored(rect.y_px - step, step);
  const int right = floored(rect.right_px() + 2 * step - 1, step);
  const int bottom = floored(rect.bottom_px() + 2 * step - 1, step);
  return {left, top, right - left, bottom - top};
}

}  // namespace

CoarseColour::CoarseColour(int scale)
    : scale_(scale),
      surfaces_({GL_RGBA8}, gl::TextureTarget::Depth::Float),
      bands_({GL_RGBA8}, gl::TextureTarget::Depth::Float) {}

DrawCall CoarseColour::begin(const DrawCall& call, const PixelRect& bounds, const glm::dmat4& world_from_object) {
  // Feathers reach a pixel beyond the mesh.
  const PixelRect reached{bounds.x_px - 2, bounds.y_px - 2, bounds.width_px + 4, bounds.height_px + 4};
  PixelRect seen = intersection(reached, call.rect);
  if (seen.empty()) seen = {call.rect.x_px, call.rect.y_px, 1, 1};
  rect_ = on_grid(seen, scale_);
  elsewhere_.emplace();
  surfaces_.begin(rect_.width_px / scale_, rect_.height_px / scale_);
  DrawCall coarse = call;
  coarse.clip_from_object =
      glm::mat4(clip_from_view(call.view, rect_) * to_matrix(call.view.camera_from_world) * world_from_object);
  coarse.rect = rect_;
  coarse.viewport_px = glm::vec2(rect_.width_px, rect_.height_px);
  return coarse;
}

void CoarseColour::begin_bands() { bands_.begin(rect_.width_px / scale_, rect_.height_px / scale_); }

void CoarseColour::end() { elsewhere_.reset(); }

CoarseColour::Uniforms::Uniforms(const gl::Program& program)
    : coarse_from_pixel(program.uniform("coarse_from_pixel")), depth_tolerance(program.uniform("depth_tolerance")) {
  glProgramUniform1i(program.name(), program.uniform("coarse_colour"), colour_unit);
  glProgramUniform1i(program.name(), program.uniform("coarse_depth"), depth_unit);
  glProgramUniform1i(program.name(), program.uniform("band_colour"), band_colour_unit);
  glProgramUniform1i(program.name(), program.uniform("band_depth"), band_depth_unit);
}

void CoarseColour::set(const Uniforms& uniforms, const DrawCall& call) const {
  glUniform3f(uniforms.coarse_from_pixel, static_cast<float>(call.rect.x_px - rect_.x_px),
              static_cast<float>(call.rect.y_px - rect_.y_px), 1.0f / static_cast<float>(scale_));
  // By how much the depth of a surface that is turned away by 27 degrees changes from texel to texel.
  glUniform1f(uniforms.depth_tolerance, static_cast<float>(0.5 * scale_ / call.view.camera.fx_px));
  glBindTextureUnit(colour_unit, surfaces_.colour(0));
  glBindTextureUnit(depth_unit, surfaces_.depth());
  glBindTextureUnit(band_colour_unit, bands_.colour(0));
  glBindTextureUnit(band_depth_unit, bands_.depth());
}

std::string_view CoarseColour::glsl() { return embedded::coarse_colour_glsl; }

}  // namespace rinkaku::passes
