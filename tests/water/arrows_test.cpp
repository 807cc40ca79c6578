#include "water/arrows.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "pipeline/frame/error.h"
#include "tests/water/waters.h"

namespace rinkaku::test {
namespace {

using water::Arrow;
using water::ArrowKey;
using water::Surface;

TEST(Arrows, BackProjectionFindsThePointThatIsSeenThere) {
  const Surface s = flat(rectangle(20, 20));
  const CameraModel camera = square_camera();
  const RigidTransform pose = looking_down(3, 35);
  for (const glm::dvec3& p : {glm::dvec3(0, 4, 0), glm::dvec3(1.5, 7, 0), glm::dvec3(-1, 2.5, 0)}) {
    const auto found = water::back_projected(s, camera, pose, seen_at(camera, pose, p));
    ASSERT_TRUE(found.found);
    EXPECT_LT(glm::distance(s.to_world(found.at), p), 1e-9);
  }
}

TEST(Arrows, NothingIsFoundAtAndAboveTheHorizon) {
  const Surface s = flat(rectangle(20, 20));
  const CameraModel camera = square_camera();
  const RigidTransform level = looking_down(3, 0);
  EXPECT_FALSE(water::back_projected(s, camera, level, {200, camera.cy_px}).found);
  EXPECT_FALSE(water::back_projected(s, camera, level, {200, camera.cy_px - 50}).found);
  EXPECT_TRUE(water::back_projected(s, camera, level, {200, camera.cy_px + 50}).found);
  try {
    water::arrow_from_screen("scene.toml:7:1", s, camera, level, {200, 300}, {200, 100});
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(std::string(e.what()).rfind("scene.toml:7:1: the arrow ends at or above the water's horizon", 0), 0u);
  }
}

TEST(Arrows, NothingIsFoundWithTheEyeInThePlane) {
  const Surface s = flat(rectangle(20, 20));
  const CameraModel camera = square_camera();
  const auto found = water::back_projected(s, camera, looking_down(0, 20), {200, 300});
  // The eye itself is the only point that is seen: never infinity or NaN.
  EXPECT_TRUE(!found.found || (std::isfinite(found.at.x) && std::isfinite(found.at.y)));
}

TEST(Arrows, OppositeKeysTurnWithoutStalling) {
  const std::vector<ArrowKey> keys{{0, {{{0, 0}, {2, 0}}}}, {30, {{{0, 0}, {-1, 0}}}}};
  std::vector<Arrow> now;
  for (int frame = 0; frame <= 30; ++frame) {
    water::arrows_at(keys, frame, now);
    ASSERT_EQ(now.size(), 1u);
    EXPECT_NEAR(glm::length(now[0].velocity), 2 - frame / 30.0, 1e-12);  // never below the slower key's
    EXPECT_GE(now[0].velocity.y, -1e-12);                                // counter-clockwise
  }
}

TEST(Arrows, TurnTheShorterWay) {
  const std::vector<ArrowKey> keys{{0, {{{0, 0}, {-1, 0.1}}}}, {10, {{{0, 0}, {-1, -0.1}}}}};
  std::vector<Arrow> now;
  water::arrows_at(keys, 5, now);
  EXPECT_LT(now[0].velocity.x, -0.99);  // over -x, not back over +x
}

TEST(Arrows, BeforeAndAfterTheKeysNothingChanges) {
  const std::vector<ArrowKey> keys{{10, {{{0, 0}, {1, 0}}}}, {20, {{{4, 0}, {0, 1}}}}};
  std::vector<Arrow> now;
  water::arrows_at(keys, 0, now);
  EXPECT_EQ(now[0].velocity, glm::dvec2(1, 0));
  water::arrows_at(keys, 99, now);
  EXPECT_EQ(now[0].at, glm::dvec2(4, 0));
  EXPECT_EQ(now[0].velocity, glm::dvec2(0, 1));
}

TEST(Arrows, StillWaterStartsToMoveInTheArrowsDirection) {
  const std::vector<ArrowKey> keys{{0, {{{0, 0}, {0, 0}}}}, {10, {{{0, 0}, {0, -2}}}}};
  std::vector<Arrow> now;
  water::arrows_at(keys, 5, now);
  EXPECT_NEAR(now[0].velocity.x, 0, 1e-12);
  EXPECT_NEAR(now[0].velocity.y, -1, 1e-12);
}

TEST(Arrows, TheWishIsTheirWeightedMean) {
  const std::vector<Arrow> two{{{0, 0}, {1, 0}}, {{3, 0}, {0, 1}}};
  // Equation 1, normalised: weights exp(-1) and exp(-2) at (1, 0) with alpha 1.
  const double a = std::exp(-1.0), b = std::exp(-2.0);
  const glm::dvec2 s = water::wished_velocity(two, 1, {1, 0});
  EXPECT_NEAR(s.x, a / (a + b), 1e-12);
  EXPECT_NEAR(s.y, b / (a + b), 1e-12);
}

TEST(Arrows, SmallAlphasTakeTheNearestArrow) {
  const std::vector<Arrow> two{{{0, 0}, {1, 0}}, {{3, 0}, {0, 1}}};
  for (const double alpha : {1e-3, 1e-300, 0.0}) {
    EXPECT_EQ(water::wished_velocity(two, alpha, {100, 0}), glm::dvec2(0, 1));
    EXPECT_EQ(water::wished_velocity(two, alpha, {-1e6, 0}), glm::dvec2(1, 0));
  }
}

TEST(Arrows, CoincidentOnesShareTheirPlace) {
  const std::vector<Arrow> same{{{1, 1}, {1, 0}}, {{1, 1}, {0, 1}}};
  EXPECT_EQ(water::wished_velocity(same, 0.1, {1, 1}), glm::dvec2(0.5, 0.5));
  const std::vector<Arrow> opposite{{{1, 1}, {1, 0}}, {{1, 1}, {-1, 0}}};
  EXPECT_EQ(water::wished_velocity(opposite, 0.1, {5, 5}), glm::dvec2(0, 0));
}

TEST(Arrows, NoneMeansStillWater) { EXPECT_EQ(water::wished_velocity({}, 1, {0, 0}), glm::dvec2(0)); }

}  // namespace
}  // namespace rinkaku::test
