#pragma once

#include <array>
#include <optional>

#include "pipeline/frame/camera_model.h"
#include "pipeline/frame/matte.h"
#include "pipeline/frame/rigid_transform.h"

namespace rinkaku::matte {

/// How far away a thing is that stands on the ground (the world's z = 0), from where its matte ends below.
///
/// The lowest pixels that are covered (a few rows of them, so that no single pixel decides) are seen through the lens,
/// and the line of sight is met with the ground. The last five distances are steadied together: each is carried on to
/// this frame at their median speed, and the median of these is taken. So one bad frame changes nothing, and somebody
/// who walks evenly isn't lagged behind.
class FootPoint {
 public:
  /// Along the camera's axis; empty if nothing is covered or the line of sight never meets the ground. One call a
  /// frame.
  std::optional<double> distance_m(const Matte& matte, const CameraModel& camera,
                                   const RigidTransform& camera_from_world);

 private:
  double steady(double depth_m);

  static constexpr int kept = 5;
  std::array<double, kept> last_m_{};  // oldest first
  int count_ = 0;
  double max_radius_ = -1;
};

}  // namespace rinkaku::matte
