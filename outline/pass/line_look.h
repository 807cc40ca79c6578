#pragma once

#include <glm/vec3.hpp>

#include "pipeline/gl/program.h"
#include "pipeline/passes/object_shape.h"
#include "pipeline/passes/pass.h"

namespace rinkaku::outline {

/// What every way of drawing a line shares.
struct LineLook {
  float width_px = 3;                     ///< at any distance; not read if width_m is given
  float width_m = 0;                      ///< above 0: the line is as wide as something of this size at its depth
  float least_px = 0, most_px = 40;       ///< between which width_m stays
  glm::vec3 colour{0.07f, 0.05f, 0.09f};  ///< sRGB-encoded
};

/// The width at a depth in metres, for a focal length in pixels.
float width_at_px(const LineLook& look, double focal_px, double depth_m);

/// The widest that lines of this look get in a frame, in pixels. The object has looked.
double widest_px(const LineLook& look, const passes::Look& seen, const passes::View& view);

/// GLSL of line_width.glsl: wished_px(depth_m), for vertex shaders.
std::string_view line_width_glsl();

/// The uniforms that line_width.glsl declares.
class LineWidthUniforms {
 public:
  LineWidthUniforms() = default;
  explicit LineWidthUniforms(const gl::Program& program);
  void set(const LineLook& look, const passes::DrawCall& call) const;

 private:
  GLint width_px_ = -1, width_limits_px_ = -1;
};

}  // namespace rinkaku::outline
