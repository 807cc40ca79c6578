#pragma once

#include <cstddef>
#include <vector>

#include "pipeline/track/pose_solver.h"

namespace rinkaku::track {

/// Settles which of a plane's two poses is the true one.
///
/// Both are followed from frame to frame by their rotation, and each one's squared reprojection errors are added up
/// with a decay of 0.97 a frame: the wrong one fits worse in the long run, even where it fits better in many single
/// frames. Choosing the nearest to the last pose instead locks onto the wrong one.
class FlipChooser {
 public:
  /// The index of the true one among this frame's candidates (one or two; not empty).
  std::size_t choose(const std::vector<PoseCandidate>& candidates);

  /// Forgets the past: the next candidates stand alone.
  void reset() { followed_.clear(); }

 private:
  struct Followed {
    glm::dquat rotation{1, 0, 0, 0};
    double error_px2 = 0;
  };
  std::vector<Followed> followed_;
  std::size_t chosen_ = 0;
};

}  // namespace rinkaku::track
