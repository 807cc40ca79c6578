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

glm::dmat4 clip_from_view(const View& view, const PixelRect& rect) {
  glm::dmat4 m = clip_from_camera(view.camera, rect, view.nearest_m);
  if (!view.mirror) return m;
  // Depth w - s h instead of near_m, with h the height above the mirror: 1 on the mirror and falling along each ray
  // behind it, as h / w grows. Below the mirror it exceeds 1 and is cut off. s keeps rays that leave the mirror steeply
  // above 0.
  constexpr double s = 0.2;
  const glm::dmat4 world_from_camera = to_matrix(inverse(view.camera_from_world));
  const glm::dvec4 height = *view.mirror * world_from_camera;
  for (int c = 0; c < 4; ++c) m[c][2] = m[c][3] - s * height[c];
  return m;
}

}  // namespace rinkaku::passes
