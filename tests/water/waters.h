#pragma once

#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "water/arrows.h"
#include "water/flow.h"
#include "water/surface.h"

// Waters and cameras for tests.
namespace rinkaku::test {

/// A flat rectangle at height z, from (-width / 2, -height / 2); edge 0 is the lower one, 1 the right, 2 the upper, 3
/// the left one.
inline water::SurfaceOutline rectangle(double width_m, double height_m, std::vector<int> open = {}, double z = 0) {
  const double x = width_m / 2, y = height_m / 2;
  return {{{-x, -y, z}, {x, -y, z}, {x, y, z}, {-x, y, z}}, std::move(open), {}};
}

inline water::Surface flat(const water::SurfaceOutline& outline) { return {"test", outline, {0, 0, 10}}; }

/// A camera `height_m` above the origin that looks along +y, `down_deg` below the horizon.
inline RigidTransform looking_down(double height_m, double down_deg) {
  const double tilt = (90 + down_deg) * std::acos(-1.0) / 180;
  const glm::dmat3 turn(glm::dvec3(1, 0, 0), glm::dvec3(0, std::cos(tilt), std::sin(tilt)),
                        glm::dvec3(0, -std::sin(tilt), std::cos(tilt)));
  RigidTransform t;
  t.rotation = glm::normalize(glm::quat_cast(turn));
  t.translation_m = -(t.rotation * glm::dvec3(0, 0, height_m));
  return t;
}

inline CameraModel square_camera(int side_px = 400, double focal_px = 360) {
  return {side_px, side_px, focal_px, focal_px, (side_px - 1) / 2.0, (side_px - 1) / 2.0, {}};
}

inline glm::dvec2 seen_at(const CameraModel& camera, const RigidTransform& camera_from_world, const glm::dvec3& point) {
  const glm::dvec3 c = camera_from_world * point;
  return to_pixels(camera, {c.x / c.z, c.y / c.z});
}

inline std::vector<water::ArrowKey> one_key(std::vector<water::Arrow> arrows) { return {{0, std::move(arrows)}}; }

}  // namespace rinkaku::test
