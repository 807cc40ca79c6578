#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "pipeline/frame/camera_model.h"
#include "pipeline/frame/rigid_transform.h"
#include "pipeline/scene/scene.h"

namespace rinkaku::pipeline {

/// The flow arrows of a scene's water as a picture shows them, and new ones from what is drawn on it: what an editor
/// needs to know. Pixels are the recording's, with its lens. No GL, any thread.
class WaterArrows {
 public:
  /// Of a scene with water. Throws Error (Input) for surfaces or arrows that can't be made, as a run of it would.
  WaterArrows(const Scene& scene, const CameraModel& camera, double frames_per_s);
  ~WaterArrows();
  WaterArrows(WaterArrows&&) noexcept;
  WaterArrows& operator=(WaterArrows&&) noexcept;

  /// One arrow, and where a picture shows it; `number` counts the arrows of its key frame.
  struct Shown {
    std::size_t surface = 0, number = 0;
    std::int64_t key_frame = 0;
    glm::dvec2 from_px{0}, to_px{0};
  };
  /// The arrows of each surface's last key frame up to this one, or of its first. Those behind the camera are left out.
  std::vector<Shown> shown(std::int64_t frame, const RigidTransform& camera_from_world) const;

  /// An arrow in the world.
  struct Placed {
    std::size_t surface = 0;
    glm::dvec3 from_m{0}, to_m{0};
  };
  /// What is drawn on the picture, on the nearest water that is seen where it begins, or on that of `surface`. Empty if
  /// there is none, or if it ends at or above the water's horizon.
  std::optional<Placed> placed(const RigidTransform& camera_from_world, glm::dvec2 from_px, glm::dvec2 to_px,
                               std::optional<std::size_t> surface = std::nullopt) const;

  /// Where the picture of a frame whose pose is known beforehand shows a point; empty if that isn't known, or the point
  /// is behind the camera.
  std::optional<glm::dvec2> pixel_at(std::int64_t frame, const glm::dvec3& point_m) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace rinkaku::pipeline
