#include "pipeline/track/one_euro.h"

#include <cmath>
#include <limits>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/pipeline/track/track_test_support.h"

namespace rinkaku::track {
namespace {

constexpr double focal_px = 600, radius_m = 0.1;

bool sound(const RigidTransform& t) {
  const double length = glm::length(t.rotation);
  return std::isfinite(length) && std::abs(length - 1) < 1e-9 && std::isfinite(glm::length(t.translation_m));
}

RigidTransform at(double x, double turn = 0) {
  RigidTransform t;
  t.translation_m = {x, 0, 1};
  t.rotation = glm::angleAxis(turn, glm::dvec3(0, 1, 0));
  return t;
}

TEST(LowPassWeight, IsThatOfTheFirstOrderFilter) {
  // tau = 1 / (2 pi fc), weight = dt / (dt + tau).
  const double tau = 1 / (2 * M_PI * 3.0);
  EXPECT_NEAR(low_pass_weight(3.0, 0.02), 0.02 / (0.02 + tau), 1e-15);
  EXPECT_EQ(low_pass_weight(1e308, 1e308), 1);
}

TEST(OneEuro, GivesTheFirstPoseAsItIs) {
  OneEuroPose filter({}, focal_px, radius_m);
  EXPECT_EQ(filter.filter(at(3, 0.4), 0).translation_m.x, 3);
}

TEST(OneEuro, StaysSoundAtAnyTimeStep) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  for (const double dt :
       {0.0, -1.0, -1e300, 1e-300, 1e-12, 1e-6, 0.03, 0.99, 3600.0, 1e300, infinity, -infinity, nan}) {
    OneEuroPose filter({}, focal_px, radius_m);
    for (int i = 0; i < 50; ++i) {
      const RigidTransform out = filter.filter(at(i % 2, 0.1 * i), dt);
      ASSERT_TRUE(sound(out)) << "dt " << dt << " step " << i;
    }
  }
}

TEST(OneEuro, StaysSoundForAnyPose) {
  OneEuroPose filter({}, focal_px, radius_m);
  RigidTransform zero, opposite = at(1, M_PI), far = at(1e12), bad = at(1);
  bad.translation_m.x = std::nan("");
  zero.translation_m = {0, 0, 0};
  for (const RigidTransform& pose : {at(1), opposite, zero, far, bad, at(1, -M_PI), at(1, 2 * M_PI)}) {
    EXPECT_TRUE(sound(filter.filter(pose, 1.0 / 30)));
  }
}

TEST(OneEuro, StartsAfreshAfterAGap) {
  OneEuroPose filter({}, focal_px, radius_m);
  filter.filter(at(0), 1.0 / 30);
  filter.filter(at(0), 1.0 / 30);
  EXPECT_EQ(filter.filter(at(5), 3600).translation_m.x, 5);
}

TEST(OneEuro, TakesTheShortWayRoundForEqualRotationsOfOppositeSign) {
  OneEuroPose filter({}, focal_px, radius_m);
  RigidTransform pose = at(0, 0.3), flipped = pose;
  flipped.rotation = -pose.rotation;
  filter.filter(pose, 1.0 / 30);
  EXPECT_NEAR(test::angle_deg(filter.filter(flipped, 1.0 / 30).rotation, pose.rotation), 0, 1e-4);
}

// A target of 60 px radius before the camera, noisy by 0.2 px in its place and 0.2 px at its rim in its rotation, as
// detected corners are: smoothing takes at least a third of the error, measured at the rim.
TEST(OneEuro, QuietensAStillTarget) {
  OneEuroPose filter({}, focal_px, radius_m);
  std::mt19937 random(5);
  std::normal_distribution<double> place(0, 0.2 / focal_px), turn(0, 0.2 / 60);
  double raw = 0, smooth = 0;
  const glm::dvec3 rim(radius_m, 0, 0);
  const auto truth = at(0, 0.3);
  for (int i = 0; i < 600; ++i) {
    RigidTransform noisy = at(place(random), 0.3 + turn(random));
    const RigidTransform out = filter.filter(noisy, 1.0 / 30);
    if (i < 30) continue;
    raw += glm::dot(noisy * rim - truth * rim, noisy * rim - truth * rim);
    smooth += glm::dot(out * rim - truth * rim, out * rim - truth * rim);
  }
  EXPECT_LT(std::sqrt(smooth / raw), 0.67);
}

// Steady motion lags by at most speed / (2 pi cutoff) <= 1 / (2 pi beta) = 0.16 px at beta 1; one frame's
// discretisation adds as much again.
TEST(OneEuro, HardlyLagsBehindSteadyMotion) {
  for (const double speed_px : {10.0, 100.0, 300.0}) {
    OneEuroPose filter({}, focal_px, radius_m);
    double lag_px = 0;
    for (int i = 0; i < 60; ++i) {
      const double x = speed_px / focal_px * i / 30.0;
      lag_px = (x - filter.filter(at(x), 1.0 / 30).translation_m.x) * focal_px;
    }
    EXPECT_LT(lag_px, 0.32) << speed_px;
    EXPECT_GE(lag_px, 0) << speed_px;
  }
}

}  // namespace
}  // namespace rinkaku::track
