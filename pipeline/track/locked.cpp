#include "pipeline/track/locked.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "pipeline/frame/error.h"

namespace rinkaku::track {
namespace {

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

class LockedTracker final : public Tracker {
 public:
  explicit LockedTracker(const RigidTransform& camera_from_world) : camera_from_world_(camera_from_world) {}

  std::optional<TrackedPose> track(const Frame& frame) override {
    TrackedPose pose;
    pose.frame_number = frame.number;
    pose.camera_from_world = camera_from_world_;
    return pose;
  }

 private:
  RigidTransform camera_from_world_;
};

}  // namespace

RigidTransform camera_from_world(std::string_view where, const LockedCamera& camera) {
  if (!finite(camera.position_m) || !finite(camera.look_at_m) || !finite(camera.up)) {
    throw input_error(where, "position_m, look_at_m and up must be finite numbers");
  }
  const glm::dvec3 view = camera.look_at_m - camera.position_m;
  const double distance = glm::length(view), up_length = glm::length(camera.up);
  if (!(distance > 1e-9) || !std::isfinite(distance)) {
    throw input_error(where, "look_at_m is the same point as position_m", "give a point in front of the camera");
  }
  if (!(up_length > 1e-9) || !std::isfinite(up_length)) {
    throw input_error(where, "up is zero", "give the direction that is up in the picture");
  }
  const glm::dvec3 z = view / distance;
  const glm::dvec3 across = glm::cross(z, camera.up / up_length);
  if (!(glm::length(across) > 1e-3)) {
    throw input_error(where, "up points along the view", "give another up, such as [0, 1, 0]");
  }
  const glm::dvec3 x = glm::normalize(across), y = glm::cross(z, x);
  RigidTransform world_from_camera;
  world_from_camera.rotation = glm::normalize(glm::quat_cast(glm::dmat3(x, y, z)));
  world_from_camera.translation_m = camera.position_m;
  return inverse(world_from_camera);
}

std::unique_ptr<Tracker> make_locked_tracker(std::string_view where, const LockedCamera& camera) {
  return std::make_unique<LockedTracker>(camera_from_world(where, camera));
}

}  // namespace rinkaku::track
