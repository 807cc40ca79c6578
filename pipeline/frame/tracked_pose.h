#pragma once

#include <cstdint>

#include "pipeline/frame/rigid_transform.h"

namespace rinkaku {

/// Where the camera was when a frame was filmed.
struct TrackedPose {
  std::int64_t frame_number = 0;
  RigidTransform camera_from_world;
  /// 1 while the pose is known or held; falls to 0 after the track was lost for longer than the hold time.
  double opacity = 1;
  /// Root mean square reprojection error in pixels; 0 where nothing was measured (pose files, held poses).
  double reprojection_rms_px = 0;
  bool held = false;  ///< not measured in this very frame
};

}  // namespace rinkaku
