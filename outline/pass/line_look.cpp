#include "outline/pass/line_look.h"

#include <algorithm>

#include "embedded/line_width.glsl.h"

namespace rinkaku::outline {

float width_at_px(const LineLook& look, double focal_px, double depth_m) {
  if (look.width_m <= 0) return look.width_px;
  return std::clamp(static_cast<float>(focal_px * look.width_m / depth_m), look.least_px, look.most_px);
}

double widest_px(const LineLook& look, const passes::Look& seen, const passes::View& view) {
  if (look.width_m > 0 && seen.crosses_eye_plane) return look.most_px;
  return width_at_px(look, view.camera.fx_px, seen.nearest_m);
}

std::string_view line_width_glsl() { return embedded::line_width_glsl; }

LineWidthUniforms::LineWidthUniforms(const gl::Program& program)
    : width_px_(program.uniform("width_px")), width_limits_px_(program.uniform("width_limits_px")) {}

void LineWidthUniforms::set(const LineLook& look, const passes::DrawCall& call) const {
  const bool metres = look.width_m > 0;
  glUniform2f(width_px_, metres ? 0 : look.width_px,
              metres ? static_cast<float>(call.view.camera.fx_px) * look.width_m : 0);
  glUniform2f(width_limits_px_, metres ? look.least_px : look.width_px, metres ? look.most_px : look.width_px);
}

}  // namespace rinkaku::outline
