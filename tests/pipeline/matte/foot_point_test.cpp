#include "pipeline/matte/foot_point.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "pipeline/matte/estimator.h"

namespace rinkaku::matte {
namespace {

const CameraModel camera{640, 480, 600, 600, 319.5, 239.5, {-0.1, 0.02}};

// 1.4 m above the ground, looking along the world's y, a little downwards.
RigidTransform camera_from_world() {
  const double tilt = 0.15;
  const glm::dvec3 z(0, std::cos(tilt), -std::sin(tilt)), x(1, 0, 0), y = glm::cross(z, x);
  RigidTransform transform;
  transform.rotation = glm::conjugate(glm::quat_cast(glm::dmat3(x, y, z)));
  transform.translation_m = -(transform.rotation * glm::dvec3(0, 0, 1.4));
  return transform;
}

// Somebody who stands at a point of the ground, as a box of pixels whose lower edge is there.
struct Standing {
  Matte matte;
  double depth_m;
};
Standing standing(const glm::dvec3& foot) {
  const glm::dvec3 seen = camera_from_world() * foot;
  const glm::dvec2 pixel = to_pixels(camera, distort(camera, glm::dvec2(seen.x, seen.y) / seen.z));
  Standing out;
  out.depth_m = seen.z;
  Matte& matte = out.matte;
  matte.width_px = 640, matte.height_px = 480;
  matte.alpha.assign(640u * 480, 0);
  // The row whose lower edge, half a pixel below its middle, is nearest to the foot is the last.
  const int bottom = static_cast<int>(std::lround(pixel.y + 0.5)), middle = static_cast<int>(std::lround(pixel.x));
  for (int y = bottom - 150; y < bottom; ++y) {
    for (int x = middle - 20; x <= middle + 20; ++x) matte.alpha_row(y)[x] = 255;
  }
  find_rect(matte);
  return out;
}

TEST(FootPoint, DistanceIsThatOfTheGroundUnderTheFeet) {
  for (const double y : {2.5, 3.0, 4.0, 6.0}) {
    for (const double x : {-0.6, 0.0, 0.7}) {
      const Standing s = standing({x, y, 0});
      const auto found = FootPoint().distance_m(s.matte, camera, camera_from_world());
      ASSERT_TRUE(found);
      // Rounded to whole pixels, half of one is y / 1.4 of its share of the depth: 0.6 y^2 / (600 * 1.4).
      EXPECT_NEAR(*found, s.depth_m, 0.0012 * y * y) << x << " " << y;
    }
  }
}

TEST(FootPoint, DoesntLagBehindAWalkerNorFollowOneBadFrame) {
  FootPoint foot;
  for (int i = 0; i < 30; ++i) {
    const Standing s = standing({0, 5 - 0.05 * i, i == 20 ? 0.6 : 0});  // in frame 20 the feet aren't seen
    const auto found = foot.distance_m(s.matte, camera, camera_from_world());
    ASSERT_TRUE(found);
    // Twice the error of a single frame, as it is carried on from others.
    const double truth = standing({0, 5 - 0.05 * i, 0}).depth_m;
    EXPECT_NEAR(*found, truth, 0.0024 * truth * truth + 0.01) << "frame " << i;
  }
}

TEST(FootPoint, NothingIsKnownOfNothingOrOfWhatStandsAboveTheHorizon) {
  Matte empty;
  empty.width_px = 640, empty.height_px = 480;
  empty.alpha.assign(640u * 480, 0);
  EXPECT_FALSE(FootPoint().distance_m(empty, camera, camera_from_world()));
  Matte high = empty;
  for (int y = 10; y < 40; ++y) high.alpha_row(y)[300] = 255;
  find_rect(high);
  EXPECT_FALSE(FootPoint().distance_m(high, camera, camera_from_world()));
}

}  // namespace
}  // namespace rinkaku::matte
