#include "water/verify/warping_error.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "water/arrows.h"

namespace rinkaku::water {
namespace {

constexpr int border_px = 4;

}  // namespace

WarpingError::WarpingError(const Flow& flow, const Surface& surface, const CameraModel& camera,
                           const RigidTransform& camera_from_world, double seconds_per_frame)
    : width_px_(static_cast<std::size_t>(camera.width_px)) {
  for (int y = border_px; y < camera.height_px - border_px; ++y) {
    for (int x = border_px; x < camera.width_px - border_px; ++x) {
      const SeenPoint p = back_projected(surface, camera, camera_from_world, glm::dvec2(x, y));
      if (!p.found || !surface.contains(p.at)) continue;
      glm::dvec2 q = p.at, velocity;
      carry_along(flow, surface, seconds_per_frame, q, velocity);
      const glm::dvec3 c = camera_from_world * surface.to_world(q);
      const glm::dvec2 to = to_pixels(camera, {c.x / c.z, c.y / c.z});
      if (to.x < 1 || to.y < 1 || to.x > camera.width_px - 3 || to.y > camera.height_px - 3 || !surface.contains(q)) {
        continue;
      }
      ways_.push_back(
          {static_cast<std::size_t>(y) * width_px_ + x, static_cast<float>(to.x), static_cast<float>(to.y)});
    }
  }
}

double WarpingError::between(std::span<const glm::vec3> picture, std::span<const glm::vec3> next) const {
  double sum = 0;
  for (const Way& w : ways_) {
    const auto i = static_cast<std::size_t>(w.x), j = static_cast<std::size_t>(w.y);
    const float fx = w.x - static_cast<float>(i), fy = w.y - static_cast<float>(j);
    const glm::vec3* s = next.data() + j * width_px_ + i;
    const glm::vec3 there =
        (s[0] * (1 - fx) + s[1] * fx) * (1 - fy) + (s[width_px_] * (1 - fx) + s[width_px_ + 1] * fx) * fy;
    const glm::vec3 d = there - picture[w.from];
    sum += glm::dot(d, d) / 3;
  }
  return ways_.empty() ? 0 : sum / static_cast<double>(ways_.size());
}

double WarpingError::contrast(std::span<const glm::vec3> picture) const {
  if (ways_.empty()) return 0;
  double mean = 0, squares = 0;
  for (const Way& w : ways_) {
    const glm::vec3 c = picture[w.from];
    const double l = (c.r + c.g + c.b) / 3;
    mean += l, squares += l * l;
  }
  const auto n = static_cast<double>(ways_.size());
  mean /= n;
  return std::sqrt(std::max(0.0, squares / n - mean * mean));
}

}  // namespace rinkaku::water
