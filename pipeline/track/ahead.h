#pragma once

#include <memory>
#include <optional>

#include "pipeline/track/tracker.h"

namespace rinkaku::track {

/// Where a pose that moves evenly will be: the last two poses known, continued.
class PosePredictor {
 public:
  /// A pose and the time at which it was filmed; times that hardly rise begin anew.
  void add(double time_s, const TrackedPose& pose);
  /// The pose at a later time; the last one known if that is all there is. Turns evenly about one axis and moves evenly
  /// in the camera's frame, for at most `longest_s`; then it stands still. Empty before the first.
  std::optional<TrackedPose> at(double time_s) const;

  static constexpr double longest_s = 0.1;

 private:
  struct Known {
    double time_s;
    TrackedPose pose;
  };
  std::optional<Known> last_, before_;
};

/// Tracks on a thread of its own, and meanwhile answers with what is predicted: a frame never waits for its own pose,
/// which may therefore be wrong where the motion changes. Of frames that come while it is busy the newest is tracked.
/// What was predicted is marked as held.
///
/// What the tracker throws comes out of the next call.
std::unique_ptr<Tracker> make_ahead(std::unique_ptr<Tracker> tracker);

}  // namespace rinkaku::track
