#include "water/arrows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>

#include "pipeline/frame/error.h"

namespace rinkaku::water {
namespace {

glm::dvec2 turned(glm::dvec2 a, glm::dvec2 b, double t) {
  const double speed_a = glm::length(a), speed_b = glm::length(b);
  const double speed = speed_a + (speed_b - speed_a) * t;
  if (!(speed > 0)) return glm::dvec2(0);
  if (!(speed_a > 0)) return b * (speed / speed_b);  // still water has no direction of its own
  if (!(speed_b > 0)) return a * (speed / speed_a);
  const double from = std::atan2(a.y, a.x);
  double by = std::atan2(b.y, b.x) - from;
  // Rounding must not decide which way exactly opposite arrows turn.
  constexpr double slack = 1e-9;
  while (by > std::numbers::pi + slack) by -= 2 * std::numbers::pi;
  while (by <= -std::numbers::pi + slack) by += 2 * std::numbers::pi;
  const double angle = from + by * t;
  return {speed * std::cos(angle), speed * std::sin(angle)};
}

}  // namespace

SeenPoint back_projected(const Surface& surface, const CameraModel& camera, const RigidTransform& camera_from_world,
                         glm::dvec2 pixel) {
  const RigidTransform world_from_camera = inverse(camera_from_world);
  const glm::dvec3& eye = world_from_camera.translation_m;
  const glm::dvec3 ray = world_from_camera.rotation * glm::dvec3(to_normalised(camera, pixel), 1.0);
  const double height = surface.height_m(eye), falls = -glm::dot(ray, surface.normal());
  // A ray that falls by less than a millionth of its way meets the plane beyond what a surface can reach.
  if (!(falls * (height < 0 ? -1 : 1) > 1e-6 * glm::length(ray))) return {};
  return {surface.from_world(eye + ray * (height / falls)), true};
}

Arrow arrow_from_screen(std::string_view where, const Surface& surface, const CameraModel& camera,
                        const RigidTransform& camera_from_world, glm::dvec2 from_px, glm::dvec2 to_px) {
  const SeenPoint from = back_projected(surface, camera, camera_from_world, from_px);
  const SeenPoint to = back_projected(surface, camera, camera_from_world, to_px);
  if (!from.found || !to.found) {
    throw input_error(where,
                      std::string("the arrow ") + (from.found ? "ends" : "begins") +
                          " at or above the water's horizon, where there is no water",
                      "draw it lower in the picture");
  }
  return {from.at, to.at - from.at};
}

void arrows_at(std::span<const ArrowKey> keys, double frame, std::vector<Arrow>& arrows) {
  arrows.clear();
  if (keys.empty()) return;
  const auto after = std::find_if(keys.begin(), keys.end(),
                                  [frame](const ArrowKey& k) { return static_cast<double>(k.frame) > frame; });
  if (after == keys.begin() || after == keys.end()) {
    const ArrowKey& key = after == keys.begin() ? keys.front() : keys.back();
    arrows.assign(key.arrows.begin(), key.arrows.end());
    return;
  }
  const ArrowKey &a = *(after - 1), &b = *after;
  const double t = (frame - static_cast<double>(a.frame)) / static_cast<double>(b.frame - a.frame);
  const std::size_t count = std::min(a.arrows.size(), b.arrows.size());
  for (std::size_t i = 0; i < count; ++i) {
    arrows.push_back({a.arrows[i].at + (b.arrows[i].at - a.arrows[i].at) * t,
                      turned(a.arrows[i].velocity, b.arrows[i].velocity, t)});
  }
}

glm::dvec2 wished_velocity(std::span<const Arrow> arrows, double alpha_m, glm::dvec2 at) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Arrow& a : arrows) nearest = std::min(nearest, glm::distance(a.at, at));
  glm::dvec2 sum(0);
  double weights = 0;
  for (const Arrow& a : arrows) {
    const double beyond = glm::distance(a.at, at) - nearest;
    const double w = beyond > 0 ? std::exp(-beyond / std::max(alpha_m, 1e-12)) : 1;
    sum += a.velocity * w;
    weights += w;
  }
  return weights > 0 ? sum / weights : glm::dvec2(0);
}

}  // namespace rinkaku::water
