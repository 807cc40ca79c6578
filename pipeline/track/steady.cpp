#include "pipeline/track/steady.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "pipeline/frame/error.h"

namespace rinkaku::track {
namespace {

class SteadyTracker final : public Tracker {
 public:
  SteadyTracker(std::unique_ptr<Tracker> tracker, const SteadyOptions& options)
      : tracker_(std::move(tracker)), options_(options) {
    target_.translation_m = options.centre_m;
    if (options.smoothing) filter_.emplace(*options.smoothing, options.focal_px, options.radius_m);
  }

  std::optional<TrackedPose> track(const Frame& frame) override {
    const double dt_s = step(frame.time_s());
    std::optional<TrackedPose> pose = tracker_->track(frame);
    return pose ? found(*pose, dt_s) : lost(frame.number, dt_s);
  }

 private:
  // Seconds since the last frame, never negative.
  double step(double time_s) {
    const double dt_s = last_time_s_ ? time_s - *last_time_s_ : 0;
    if (std::isfinite(time_s)) last_time_s_ = time_s;
    if (dt_s > 0) usual_step_s_ = std::min(dt_s, 1.0);
    return dt_s > 0 && std::isfinite(dt_s) ? dt_s : usual_step_s_;
  }

  TrackedPose found(TrackedPose pose, double dt_s) {
    RigidTransform measured = pose.camera_from_world * target_;
    const bool was_lost = lost_for_s_ > 0;
    const bool was_gone = ever_seen_ && opacity_ <= 0;
    if (was_lost && !was_gone && ever_seen_ && !is_clear_jump(last_, measured)) {
      blend_from_ = last_;
      blend_left_s_ = options_.blend_s;
    } else if (was_lost) {
      blend_left_s_ = 0;
    }
    if (was_lost && filter_) filter_->reset();
    if (!ever_seen_) {
      opacity_ = 1;
    } else if (opacity_ < 1) {
      opacity_ = options_.fade_s > 0 ? std::min(1.0, opacity_ + dt_s / options_.fade_s) : 1;
    }
    ever_seen_ = true;
    lost_for_s_ = 0;

    if (filter_) measured = filter_->filter(measured, dt_s);
    if (blend_left_s_ > 0) {
      blend_left_s_ = std::max(0.0, blend_left_s_ - dt_s);
      measured = between(blend_from_, measured, 1 - blend_left_s_ / options_.blend_s);
    }
    last_ = measured;
    pose.camera_from_world = measured * inverse(target_);
    pose.opacity = opacity_;
    return pose;
  }

  std::optional<TrackedPose> lost(std::int64_t frame_number, double dt_s) {
    if (!ever_seen_ || opacity_ <= 0) return {};
    const double faded_before_s = std::max(0.0, lost_for_s_ - options_.hold_s);
    lost_for_s_ += dt_s;
    // A loss that began within this frame's step counts from the last sighting on.
    const double faded_s = std::max(0.0, lost_for_s_ - options_.hold_s);
    constexpr double rounding_s = 1e-9;  // of sums of time steps
    if (faded_s > rounding_s) {
      opacity_ -= options_.fade_s > 0 ? (faded_s - faded_before_s) / options_.fade_s : 1;
      if (opacity_ <= rounding_s) {
        opacity_ = 0;
        return {};
      }
    }
    TrackedPose pose;
    pose.frame_number = frame_number;
    pose.camera_from_world = last_ * inverse(target_);
    pose.opacity = opacity_;
    pose.held = true;
    return pose;
  }

  // Further in the picture than the target is wide, or turned by more than half a right angle.
  bool is_clear_jump(const RigidTransform& a, const RigidTransform& b) const {
    const double distance_m = std::max(glm::length(b.translation_m), 1e-9);
    const glm::dvec3 move = b.translation_m - a.translation_m;
    const double sideways_m = std::hypot(move.x, move.y);
    const double turn = 2 * std::acos(std::min(1.0, std::abs(glm::dot(a.rotation, b.rotation))));
    return sideways_m > options_.radius_m || std::abs(move.z) > 0.25 * distance_m || turn > 0.8;
  }

  static RigidTransform between(const RigidTransform& a, const RigidTransform& b, double part) {
    return {glm::normalize(glm::slerp(a.rotation, b.rotation, part)), glm::mix(a.translation_m, b.translation_m, part)};
  }

  std::unique_ptr<Tracker> tracker_;
  SteadyOptions options_;
  RigidTransform target_;  // world_from_target
  std::optional<OneEuroPose> filter_;

  std::optional<double> last_time_s_;
  double usual_step_s_ = 1.0 / 30;
  bool ever_seen_ = false;
  double opacity_ = 0;
  double lost_for_s_ = 0;
  RigidTransform last_;  // camera_from_target as last given
  RigidTransform blend_from_;
  double blend_left_s_ = 0;
};

}  // namespace

std::unique_ptr<Tracker> make_steady(std::unique_ptr<Tracker> tracker, const SteadyOptions& options) {
  const auto check = [](const char* name, double value, bool zero_allowed) {
    if (std::isfinite(value) && (value > 0 || (zero_allowed && value == 0))) return;
    throw input_error({}, std::string(name) + (zero_allowed ? " must be 0 or more" : " must be more than 0"));
  };
  check("hold_s", options.hold_s, true);
  check("fade_s", options.fade_s, true);
  check("blend_s", options.blend_s, true);
  if (options.smoothing) {
    check("min_cutoff_hz", options.smoothing->min_cutoff_hz, false);
    check("beta", options.smoothing->beta, true);
    check("derivative_cutoff_hz", options.smoothing->derivative_cutoff_hz, false);
  }
  assert(options.focal_px > 0 && options.radius_m > 0);
  return std::make_unique<SteadyTracker>(std::move(tracker), options);
}

}  // namespace rinkaku::track
