#pragma once

#include <memory>
#include <optional>

#include <glm/vec3.hpp>

#include "pipeline/track/one_euro.h"
#include "pipeline/track/tracker.h"

namespace rinkaku::track {

/// What make_steady() does to the poses of a tracker.
struct SteadyOptions {
  std::optional<OneEuroOptions> smoothing;  ///< empty: measured poses are given as they are
  double hold_s = 0.3;                      ///< a lost pose is kept for so long (>= 0)
  double fade_s = 0.3;  ///< then opacity falls to 0 over this time (>= 0), and rises over it when the pose is back
  /// A pose found again while the last one was held is reached over this time, unless it is a clear jump away.
  double blend_s = 0.1;
  double focal_px = 1000;        ///< the camera's, for speeds in pixels
  glm::dvec3 centre_m{0, 0, 0};  ///< of what is tracked, in the world: poses are smoothed and blended about it
  double radius_m = 0.1;         ///< of what is tracked (> 0)
};

/// Makes a tracker's poses steady: smooths them, and bridges losses.
///
/// Lost: the last pose is held for hold_s, then fades out over fade_s, then there is none. Found again: opacity rises
/// from where it was over fade_s (the very first sighting shows at once), and after a loss that was only held the pose
/// moves from the held one to the measured one within blend_s, unless it lies so far away that gliding would be seen as
/// wrong for longer than a jump. Time is the frames' own; where it stands still or runs backwards, the last step
/// counts. Throws Error (Input) for options that are negative or not finite.
std::unique_ptr<Tracker> make_steady(std::unique_ptr<Tracker> tracker, const SteadyOptions& options);

}  // namespace rinkaku::track
