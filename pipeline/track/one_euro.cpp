#include "pipeline/track/one_euro.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace rinkaku::track {
namespace {

constexpr double longest_gap_s = 1.0;
// Closer frames than this are timestamps that were rounded, not a camera that fast.
constexpr double shortest_gap_s = 1e-5;

bool finite(const RigidTransform& t) {
  const double sum = t.rotation.w + t.rotation.x + t.rotation.y + t.rotation.z + t.translation_m.x + t.translation_m.y +
                     t.translation_m.z;
  return std::isfinite(sum);
}

// The turn that takes `from` to `to`, as axis times angle.
glm::dvec3 rotation_vector(const glm::dquat& from, const glm::dquat& to) {
  glm::dquat turn = to * glm::conjugate(from);
  if (turn.w < 0) turn = -turn;
  const glm::dvec3 axis(turn.x, turn.y, turn.z);
  const double sine = glm::length(axis);
  if (sine < 1e-15) return {0, 0, 0};
  return axis * (2 * std::atan2(sine, turn.w) / sine);
}

}  // namespace

double low_pass_weight(double cutoff_hz, double dt_s) {
  const double turns = 2 * std::numbers::pi * cutoff_hz * dt_s;
  return std::isinf(turns) ? 1 : turns / (1 + turns);
}

OneEuroPose::OneEuroPose(const OneEuroOptions& options, double focal_px, double radius_m)
    : options_(options), focal_px_(focal_px), radius_m_(radius_m) {}

RigidTransform OneEuroPose::filter(const RigidTransform& pose, double dt_s) {
  if (!finite(pose)) return started_ ? smoothed_ : pose;
  if (!(dt_s > 0)) dt_s = last_dt_s_;
  if (!started_ || !(dt_s <= longest_gap_s)) {
    started_ = true;
    raw_ = smoothed_ = pose;
    velocity_ = angular_velocity_ = {0, 0, 0};
    return pose;
  }
  dt_s = std::max(dt_s, shortest_gap_s);
  last_dt_s_ = dt_s;

  const double speed_weight = low_pass_weight(options_.derivative_cutoff_hz, dt_s);
  velocity_ = glm::mix(velocity_, (pose.translation_m - raw_.translation_m) / dt_s, speed_weight);
  angular_velocity_ = glm::mix(angular_velocity_, rotation_vector(raw_.rotation, pose.rotation) / dt_s, speed_weight);
  raw_ = pose;

  const auto weight = [&](double speed_px) {
    return low_pass_weight(options_.min_cutoff_hz + options_.beta * speed_px, dt_s);
  };
  // A target beside or behind the camera is in no picture; its distance keeps the scale within reason there.
  const glm::dvec3& place = pose.translation_m;
  const double distance_m = std::max({std::abs(place.z), 0.2 * glm::length(place), 1e-9});
  const double px_per_m = focal_px_ / distance_m;
  const double rim_px = px_per_m * radius_m_;
  const glm::dvec3 weights(weight(px_per_m * std::abs(velocity_.x)), weight(px_per_m * std::abs(velocity_.y)),
                           weight(rim_px * std::abs(velocity_.z) / distance_m));
  smoothed_.translation_m = glm::mix(smoothed_.translation_m, pose.translation_m, weights);
  smoothed_.rotation =
      glm::normalize(glm::slerp(smoothed_.rotation, pose.rotation, weight(rim_px * glm::length(angular_velocity_))));
  return smoothed_;
}

}  // namespace rinkaku::track
