#include "pipeline/passes/view.h"

namespace rinkaku::passes {

glm::dmat4 clip_from_camera(const CameraModel& camera, const PixelRect& rect, double near) {
  // Half a pixel: the rectangle's edge lies that far outside the centre of its first pixel.
  const double left = rect.x_px - 0.5, top = rect.y_px - 0.5;
  const double sx = 2.0 / rect.width_px, sy = 2.0 / rect.height_px;
  glm::dmat4 m(0.0);
  m[0][0] = sx * camera.fx_px;
  m[2][0] = sx * (camera.cx_px - left) - 1;
  m[1][1] = sy * camera.fy_px;
  m[2][1] = sy * (camera.cy_px - top) - 1;
  m[3][2] = near;
  m[2][3] = 1;
  return m;
}

}  // namespace rinkaku::passes
