#pragma once

#include <memory>
#include <optional>

#include "pipeline/frame/frame.h"
#include "pipeline/frame/tracked_pose.h"

namespace rinkaku::track {

/// Tells where the camera was when a frame was filmed. Frames come in order; used from one thread at a time.
///
/// make_tracker.h builds one from options; marker_tracker.h, pose_file.h, locked.h and steady.h hold the parts.
class Tracker {
 public:
  virtual ~Tracker() = default;

  /// Empty while no pose is known: before the marker was first seen, outside a pose file's span, and after a loss that
  /// outlasted hold and fade.
  virtual std::optional<TrackedPose> track(const Frame& frame) = 0;
};

}  // namespace rinkaku::track
