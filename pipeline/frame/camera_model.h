#pragma once

#include <array>
#include <optional>

#include <glm/vec2.hpp>

namespace rinkaku {

/// A pinhole camera with OpenCV's rational, tangential and thin-prism lens distortion.
///
/// The camera looks along +z, x right and y down. Pixel (0, 0) is the centre of the top left pixel, as OpenCV has it.
/// A point (X, Y, Z) in the camera's frame has the normalised coordinates (X / Z, Y / Z); without distortion it is seen
/// at (fx X/Z + cx, fy Y/Z + cy).
struct CameraModel {
  int width_px = 0;
  int height_px = 0;
  double fx_px = 0;
  double fy_px = 0;
  double cx_px = 0;
  double cy_px = 0;
  /// OpenCV's order: k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 tau_x tau_y; those not given are 0. tau must be 0.
  std::array<double, 14> distortion{};

  bool has_distortion() const;
};

/// Normalised coordinates through the lens distortion (OpenCV's projectPoints).
glm::dvec2 distort(const CameraModel& camera, glm::dvec2 normalised);

/// The normalised radius inside which the radial distortion grows with the radius; infinite if it never folds.
/// Costs some 4,000 evaluations: call it once a camera.
double max_undistorted_radius(const CameraModel& camera);

/// The inverse of distort(): Newton's method, to 1e-12. Empty where the distortion folds, that is, where no point
/// inside `max_radius` (from max_undistorted_radius) is seen there.
std::optional<glm::dvec2> undistort(const CameraModel& camera, glm::dvec2 distorted, double max_radius);

inline glm::dvec2 to_pixels(const CameraModel& camera, glm::dvec2 normalised) {
  return {camera.fx_px * normalised.x + camera.cx_px, camera.fy_px * normalised.y + camera.cy_px};
}
inline glm::dvec2 to_normalised(const CameraModel& camera, glm::dvec2 pixel) {
  return {(pixel.x - camera.cx_px) / camera.fx_px, (pixel.y - camera.cy_px) / camera.fy_px};
}

}  // namespace rinkaku
