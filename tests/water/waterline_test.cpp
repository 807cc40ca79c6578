#include "water/waterline.h"

#include <map>

#include <gtest/gtest.h>

#include "tests/water/waters.h"

namespace rinkaku::test {
namespace {

water::Solid tetrahedron() {
  return {{{0, 0, 1}, {1, 0, -1}, {-1, 1, -1}, {-1, -1, -1}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
}

TEST(Section, OfASolidIsAClosedLine) {
  const water::Surface s = flat(rectangle(10, 10));
  const auto segments = water::section(tetrahedron(), s);
  ASSERT_EQ(segments.size(), 3u);
  // The base's edges at half their size: sides sqrt(5), sqrt(5) and 2 halved.
  double length = 0;
  for (const auto& g : segments) length += glm::distance(g.a, g.b);
  EXPECT_NEAR(length, (std::sqrt(5.0) + std::sqrt(5.0) + 2) / 2, 1e-6);
}

TEST(Section, IsEmptyAboveAndOutsideTheWater) {
  water::Solid solid = tetrahedron();
  EXPECT_TRUE(water::section(solid, flat(rectangle(10, 10, {}, 5))).empty());
  for (glm::vec3& p : solid.positions_m) p.x += 20;
  EXPECT_TRUE(water::section(solid, flat(rectangle(10, 10))).empty());
}

TEST(Waterline, LiesOnTheShoresAndChangesSlowly) {
  const water::Surface s = flat(rectangle(6, 4, {1, 3}));
  const CameraModel camera = square_camera();
  const RigidTransform pose = looking_down(3, 60);
  water::WaterlineOptions options;
  options.size.length_m = 0.3;
  const water::Waterline line(s, {}, options);
  water::Strokes before, now;
  line.add(0, camera, pose, before);
  ASSERT_GT(before.size(), 50u);
  for (int frame = 1; frame < 200; ++frame) {
    now.clear();
    line.add(frame, camera, pose, now);
    ASSERT_EQ(now.size(), before.size());
    for (std::size_t i = 0; i < now.size(); ++i) {
      ASSERT_EQ(now[i].middle_px, before[i].middle_px);
      ASSERT_NEAR(now[i].colour[3], before[i].colour[3], 0.1 * 255);
      const auto at = water::back_projected(s, camera, pose, now[i].middle_px);
      ASSERT_NEAR(std::abs(s.to_world(at.at).y), 2, 1e-3);
    }
    std::swap(before, now);
  }
}

TEST(Spray, DropsAppearAndVanishUnseenAndChangeSlowly) {
  water::SprayOptions options;
  options.from_m = {-1, 4, 0}, options.to_m = {1, 4, 0};
  options.drops = 50;
  const CameraModel camera = square_camera();
  const RigidTransform pose = looking_down(1, 10);
  water::Strokes before, now;
  add_spray(options, 0, camera, pose, before);
  for (int frame = 1; frame < 300; ++frame) {
    now.clear();
    add_spray(options, frame, camera, pose, now);
    ASSERT_EQ(now.size(), 50u);
    for (std::size_t i = 0; i < now.size(); ++i) {
      ASSERT_NEAR(now[i].colour[3], before[i].colour[3], 0.1 * 255);
      // Where a new life begins elsewhere, neither is seen.
      if (glm::distance(now[i].middle_px, before[i].middle_px) > 20) {
        ASSERT_LT(before[i].colour[3], 0.1 * 255);
        ASSERT_LT(now[i].colour[3], 0.1 * 255);
      }
    }
    std::swap(before, now);
  }
}

}  // namespace
}  // namespace rinkaku::test
