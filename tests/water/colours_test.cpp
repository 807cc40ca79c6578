#include "water/colours.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/water/waters.h"

namespace rinkaku::test {
namespace {

// The paper's equation 3, with the power that its print lacks.
double printed(double t) {
  t = std::abs(t);
  if (t < 1) return (3 * t * t * t - 6 * t * t + 4) / 6;
  return t < 2 ? -std::pow(t - 2, 3) / 6 : 0;
}

TEST(Colours, SplineWeightsAreThePapers) {
  for (double t = 0; t <= 1; t += 0.125) {
    const auto w = water::spline_weights(t);
    double sum = 0;
    for (int k = 0; k < 4; ++k) {
      EXPECT_NEAR(w[k], printed(t - (k - 1)), 1e-6);
      sum += w[k];
    }
    EXPECT_NEAR(sum, 1, 1e-6);
  }
}

TEST(Colours, KeysOnALineGiveTheLine) {
  water::KeyColours keys(3, 15);
  for (int k = 0; k < 8; ++k) keys.set(1, k, glm::vec3(0.1f * static_cast<float>(k)));
  for (int frame = 15; frame < 75; ++frame) {
    EXPECT_NEAR(keys.at(1, frame).g, 0.1 * frame / 15, 1e-6);
  }
}

TEST(Colours, AStepBetweenKeysIsSpreadOut) {
  water::KeyColours keys(1, 15);
  for (int k = 0; k < 8; ++k) keys.set(0, k, glm::vec3(k < 4 ? 0.f : 1.f));
  float most = 0;
  for (int frame = 15; frame < 75; ++frame) {
    const float change = keys.at(0, frame + 1).r - keys.at(0, frame).r;
    EXPECT_GE(change, 0);
    most = std::max(most, change);
  }
  EXPECT_LT(most, 0.06);  // the spline's steepest slope for a step is 3/4 a key: 0.05 a frame
}

TEST(Colours, FollowedOnesLagFourFramesBehindAnEvenChange) {
  water::FollowedColours colours(1);
  colours.start(0, glm::vec3(0));
  for (int frame = 1; frame <= 200; ++frame) colours.follow(0, glm::vec3(0.001f * static_cast<float>(frame)));
  EXPECT_NEAR((0.2 - colours.at(0).r) / 0.001, 4, 0.01);
}

TEST(Colours, TheMeanIsThatOfNinePlaces) {
  // Water that mirrors a gradient sky, seen at a slant: smooth, so that the mean of nine places lies near the middle.
  const water::Surface s = flat(rectangle(20, 20));
  const CameraModel camera = square_camera(100, 90);
  const RigidTransform pose = looking_down(2, 30);
  water::ReferencePicture reference;
  reference.paint(s, camera, pose, {}, nullptr, nullptr, 1, 1);
  glm::vec3 sum(0);
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) sum += reference.at({40 + 6 * x, 60 + 4 * y});
  }
  const glm::vec3 mean = water::neighbourhood_mean(reference, {40, 60}, {6, 4});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], sum[c] / 9, 1e-6);
}

}  // namespace
}  // namespace rinkaku::test
