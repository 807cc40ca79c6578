#pragma once

#include <glm/vec3.hpp>

#include "pipeline/frame/rigid_transform.h"

namespace rinkaku::track {

/// How strongly the One-Euro filter smooths: below min_cutoff_hz what stands still, ever less the faster it moves.
struct OneEuroOptions {
  double min_cutoff_hz = 1.0;
  /// Cutoff gained per pixel/s of motion in the picture. Steady motion lags by at most 1 / (2 pi beta) pixels, 0.16 px
  /// at 1; motion that changes lags more.
  double beta = 1.0;
  double derivative_cutoff_hz = 3.0;  ///< of the speed; the paper takes 1, which trails behind quick turns
};

/// The weight of a new sample in a first-order low-pass filter sampled every `dt_s` (> 0): 1 / (1 + tau / dt).
double low_pass_weight(double cutoff_hz, double dt_s);

/// Smooths the pose of a target before the camera: the place of its centre and its rotation, both in the camera's
/// frame.
///
/// A target's noise is little in its direction, more in its distance and most in its rotation, and these hardly hang
/// together; filtering the camera's pose in the target's frame instead would turn rotation noise into noise of place
/// that grows with the distance. Speeds are measured in pixels, as a viewer would see them: sideways motion by the
/// target's distance, motion in depth and rotation by what they do to the target's rim. So the same options suit any
/// unit of length, any lens and any size of target.
///
/// Each axis of the place is filtered on its own, the rotation by slerp with its angular velocity filtered as a vector.
/// Casiez, Roussel, Vogel: 1-Euro Filter, CHI 2012, equations 3 to 9. A few hundred nanoseconds a call.
class OneEuroPose {
 public:
  /// `focal_px` is the camera's focal length, `radius_m` the target's radius; both positive.
  OneEuroPose(const OneEuroOptions& options, double focal_px, double radius_m);

  /// The smoothed pose. `camera_from_target` has the target's centre as its origin. `dt_s` is the time since the last
  /// call; if it is not positive, nothing is known of the speed and the last positive one is taken (1/30 s at first);
  /// after more than a second, or if a value is not finite, the filter starts afresh.
  RigidTransform filter(const RigidTransform& camera_from_target, double dt_s);

  /// The next pose is taken as it is.
  void reset() { started_ = false; }

 private:
  OneEuroOptions options_;
  double focal_px_;
  double radius_m_;
  bool started_ = false;
  double last_dt_s_ = 1.0 / 30;
  RigidTransform raw_;              // the last one given in
  RigidTransform smoothed_;         // the last one given out
  glm::dvec3 velocity_{0};          // low-passed, metres/s
  glm::dvec3 angular_velocity_{0};  // low-passed, radians/s
};

}  // namespace rinkaku::track
