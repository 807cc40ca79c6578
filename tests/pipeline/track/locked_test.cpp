#include "pipeline/track/locked.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/pipeline/track/track_test_support.h"

namespace rinkaku::track {
namespace {

TEST(LockedCamera, LooksAtThePointWithUpUp) {
  const LockedCamera locked{{0, -2, 1}, {0, 0, 1}, {0, 0, 3}};
  const RigidTransform pose = camera_from_world("scene", locked);
  // The point looked at lies ahead; what is above is at negative y; what is at world +x is to the right.
  EXPECT_NEAR(glm::distance(pose * locked.look_at_m, glm::dvec3(0, 0, 2)), 0, 1e-12);
  EXPECT_NEAR(glm::distance(pose * glm::dvec3(0, 0, 1.5), glm::dvec3(0, -0.5, 2)), 0, 1e-12);
  EXPECT_NEAR(glm::distance(pose * glm::dvec3(0.25, 0, 1), glm::dvec3(0.25, 0, 2)), 0, 1e-12);
  EXPECT_NEAR(glm::length(pose * locked.position_m), 0, 1e-12);
}

TEST(LockedCamera, GivesEveryFrameTheSamePose) {
  auto tracker = make_locked_tracker("scene", {{1, 0, 0}, {1, 5, 0}, {0, 0, 1}});
  for (const int number : {0, 7}) {
    Frame frame;
    frame.number = number;
    const auto pose = tracker->track(frame);
    ASSERT_TRUE(pose);
    EXPECT_EQ(pose->frame_number, number);
    EXPECT_EQ(pose->opacity, 1);
    EXPECT_NEAR(glm::distance(pose->camera_from_world * glm::dvec3(1, 5, 0), glm::dvec3(0, 0, 5)), 0, 1e-12);
  }
}

TEST(LockedCamera, RefusesWhatHasNoDirection) {
  const double nan = std::nan("");
  EXPECT_REFUSED(camera_from_world("s:1:2", {{1, 2, 3}, {1, 2, 3}, {0, 0, 1}}), "s:1:2: look_at_m is the same point");
  EXPECT_REFUSED(camera_from_world("s", {{0, 0, 0}, {0, 0, 5}, {0, 0, 1}}), "up points along the view");
  EXPECT_REFUSED(camera_from_world("s", {{0, 0, 0}, {0, 0, 5}, {0, 0, -1}}), "up points along the view");
  EXPECT_REFUSED(camera_from_world("s", {{0, 0, 0}, {0, 1, 0}, {0, 0, 0}}), "up is zero");
  EXPECT_REFUSED(camera_from_world("s", {{nan, 0, 0}, {0, 1, 0}, {0, 0, 1}}), "finite");
  EXPECT_REFUSED(camera_from_world("s", {{0, 0, 0}, {0, 1e308 * 10, 0}, {0, 0, 1}}), "finite");
}

}  // namespace
}  // namespace rinkaku::track
