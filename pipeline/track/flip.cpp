#include "pipeline/track/flip.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/gtc/quaternion.hpp>

namespace rinkaku::track {
namespace {

constexpr double decay = 0.97;
// What a pose gets ahead that was beyond doubt (markers in several planes), once doubt comes back.
constexpr double head_start_px2 = 200;

double angle_between(const glm::dquat& a, const glm::dquat& b) {
  return 2 * std::acos(std::min(1.0, std::abs(glm::dot(a, b))));
}

}  // namespace

std::size_t FlipChooser::choose(const std::vector<PoseCandidate>& candidates) {
  assert(!candidates.empty() && candidates.size() <= 2);
  std::vector<double> before(candidates.size(), 0.0);
  const auto turn = [&](std::size_t f, std::size_t c) {
    return angle_between(followed_[f].rotation, candidates[c].camera_from_world.rotation);
  };
  if (candidates.size() == 2 && followed_.size() == 2) {
    const bool straight = turn(0, 0) + turn(1, 1) <= turn(0, 1) + turn(1, 0);
    before = {followed_[straight ? 0 : 1].error_px2, followed_[straight ? 1 : 0].error_px2};
  } else if (candidates.size() == 2 && followed_.size() == 1) {
    before[turn(0, 0) <= turn(0, 1) ? 1 : 0] = head_start_px2;
  }
  followed_.resize(candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    followed_[i] = {candidates[i].camera_from_world.rotation, before[i] * decay + candidates[i].squared_error_px2};
  }
  chosen_ = followed_.size() == 2 && followed_[1].error_px2 < followed_[0].error_px2 ? 1 : 0;
  return chosen_;
}

}  // namespace rinkaku::track
