#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "pipeline/frame/camera_model.h"
#include "pipeline/frame/rigid_transform.h"
#include "water/flow.h"
#include "water/surface.h"

namespace rinkaku::water {

/// How much pictures of flowing water flicker: the mean squared difference between a picture and the next one carried
/// back along the flow, by bilinear sampling, over the water whose way stays in the picture. (Lai et al. 2018.)
/// An empty picture doesn't flicker, so look at contrast() as well. GL-free.
class WarpingError {
 public:
  /// The flow as it is now; the camera stands still. Pixels within four of the picture's border are left out.
  WarpingError(const Flow& flow, const Surface& surface, const CameraModel& camera,
               const RigidTransform& camera_from_world, double seconds_per_frame);
  /// Pictures of the camera's size, rows from the top. Mean over the three components, which are from 0 to 1.
  double between(std::span<const glm::vec3> picture, std::span<const glm::vec3> next) const;
  /// Standard deviation of the components' mean over the same pixels.
  double contrast(std::span<const glm::vec3> picture) const;
  std::size_t pixels() const { return ways_.size(); }

 private:
  struct Way {
    std::size_t from;
    float x, y;
  };
  std::size_t width_px_;
  std::vector<Way> ways_;
};

}  // namespace rinkaku::water
