#pragma once

#include <memory>
#include <string_view>

#include <glm/vec3.hpp>

#include "pipeline/frame/rigid_transform.h"
#include "pipeline/track/tracker.h"

namespace rinkaku::track {

/// A camera that stands still: where it stands, a point in the middle of its view, and which way is up. World, metres;
/// `up` needs no unit length.
struct LockedCamera {
  glm::dvec3 position_m{0, 0, 0};
  glm::dvec3 look_at_m{0, 1, 0};
  glm::dvec3 up{0, 0, 1};
};

/// The pose of such a camera (x right, y down, z forward). Throws Error (Input), naming `where`, if a value is not
/// finite, the point looked at is the position, or up is zero or (within 0.06 degrees) along the view.
RigidTransform camera_from_world(std::string_view where, const LockedCamera& camera);

/// Gives this pose for every frame. Throws as camera_from_world().
std::unique_ptr<Tracker> make_locked_tracker(std::string_view where, const LockedCamera& camera);

}  // namespace rinkaku::track
