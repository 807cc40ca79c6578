#include "pipeline/frame/camera_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>

namespace rinkaku {
namespace {

// The radial factor (1 + k1 r2 + k2 r4 + k3 r6) / (1 + k4 r2 + k5 r4 + k6 r6).
struct Radial {
  double k1, k2, k3, k4, k5, k6;
  double numerator(double r2) const { return 1 + r2 * (k1 + r2 * (k2 + r2 * k3)); }
  double denominator(double r2) const { return 1 + r2 * (k4 + r2 * (k5 + r2 * k6)); }
  double factor(double r2) const { return numerator(r2) / denominator(r2); }
  // d(r factor(r^2)) / dr; the distortion folds where it is no longer positive.
  double slope(double r2) const {
    const double n = numerator(r2), d = denominator(r2);
    const double dn = k1 + r2 * (2 * k2 + r2 * 3 * k3), dd = k4 + r2 * (2 * k5 + r2 * 3 * k6);
    return n / d + 2 * r2 * (dn * d - n * dd) / (d * d);
  }
};

Radial radial(const CameraModel& camera) {
  const auto& k = camera.distortion;
  return {k[0], k[1], k[4], k[5], k[6], k[7]};
}

}  // namespace

bool CameraModel::has_distortion() const {
  return std::any_of(distortion.begin(), distortion.end(), [](double k) { return k != 0; });
}

glm::dvec2 distort(const CameraModel& camera, glm::dvec2 p) {
  const auto& k = camera.distortion;
  const double r2 = glm::dot(p, p), r4 = r2 * r2;
  const double f = radial(camera).factor(r2);
  return {p.x * f + 2 * k[2] * p.x * p.y + k[3] * (r2 + 2 * p.x * p.x) + k[8] * r2 + k[9] * r4,
          p.y * f + k[2] * (r2 + 2 * p.y * p.y) + 2 * k[3] * p.x * p.y + k[10] * r2 + k[11] * r4};
}

double max_undistorted_radius(const CameraModel& camera) {
  if (!camera.has_distortion()) return std::numeric_limits<double>::infinity();
  const Radial lens = radial(camera);
  // Beyond 20 (174 degrees of view) no picture reaches; a step of 0.005 finds every fold that a calibration can make.
  constexpr double end = 20, step = 0.005;
  for (double r = step; r < end; r += step) {
    const double r2 = r * r;
    if (!(lens.denominator(r2) > 0) || !(lens.slope(r2) > 0)) return r - step;
  }
  return std::numeric_limits<double>::infinity();
}

std::optional<glm::dvec2> undistort(const CameraModel& camera, glm::dvec2 distorted, double limit) {
  if (!camera.has_distortion()) return distorted;
  glm::dvec2 p = distorted;
  if (const double r = glm::length(p); r > 0.9 * limit) p *= 0.9 * limit / r;
  constexpr double h = 1e-7, tolerance = 1e-12;
  for (int i = 0; i < 50; ++i) {
    const glm::dvec2 miss = distort(camera, p) - distorted;
    if (glm::length(miss) < tolerance) return glm::length(p) <= limit ? std::optional(p) : std::nullopt;
    const glm::dvec2 dx = (distort(camera, p + glm::dvec2(h, 0)) - distort(camera, p - glm::dvec2(h, 0))) / (2 * h);
    const glm::dvec2 dy = (distort(camera, p + glm::dvec2(0, h)) - distort(camera, p - glm::dvec2(0, h))) / (2 * h);
    const glm::dmat2 jacobian(dx, dy);
    const double det = dx.x * dy.y - dx.y * dy.x;
    if (!(std::abs(det) > 1e-12)) return std::nullopt;
    glm::dvec2 next = p - glm::inverse(jacobian) * miss;
    // A step may not leave the part where the lens is one-to-one.
    if (const double r = glm::length(next); r > limit) next *= limit / r;
    if (glm::length(next - p) < 1e-15) break;
    p = next;
  }
  const double left = glm::length(distort(camera, p) - distorted);
  return left < 1e-9 && glm::length(p) < limit ? std::optional(p) : std::nullopt;
}

}  // namespace rinkaku
