#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "outline/pass/hull_pass.h"
#include "pipeline/passes/holdout/holdout_pass.h"
#include "tests/pipeline/passes/drawing.h"
#include "tests/pipeline/passes/gl_test.h"
#include "tests/pipeline/passes/shapes.h"

namespace rinkaku::test {
namespace {

using passes::Layer;
using passes::View;

class Holdout : public GlTest {};

passes::StyledObject holdout(const mesh::Mesh& mesh, const glm::dmat4& camera_from_object) {
  passes::StyledObject styled;
  styled.object = std::make_unique<passes::DrawnObject>(passes::ObjectShape(mesh, camera_from_object));
  styled.passes.push_back(std::make_unique<passes::HoldoutPass>(*styled.object));
  return styled;
}

int alpha_at(const Layer& layer, int x, int y) {
  const passes::PixelRect& r = layer.rect;
  if (x < r.x_px || y < r.y_px || x >= r.right_px() || y >= r.bottom_px()) return 0;
  return at(layer, x, y)[3];
}

TEST_F(Holdout, AloneDrawsNothing) {
  const View v = view(64, 64, 60);
  const Layer layer = drawn(scene_of(holdout(sphere(3), moved(0, 0, 4))), v);
  EXPECT_TRUE(std::all_of(layer.rgba.begin(), layer.rgba.end(), [](std::uint8_t b) { return b == 0; }));
}

// What the ball hides of the square behind it is what the ball itself would cover, to the last fraction of a pixel.
TEST_F(Holdout, CutsItsOwnCoverageOutOfWhatIsBehind) {
  const View v = view(96, 96, 90);
  const mesh::Mesh ball = sphere(5);
  const Layer solid = drawn(scene_of(toon(ball, moved(0.1, 0.05, 4))), v);
  const Layer cut = drawn(scene_of(toon(square(), moved(0, 0, 8) * scaled(6)), holdout(ball, moved(0.1, 0.05, 4))), v);
  int between = 0;
  for (int y = 0; y < 96; ++y) {
    for (int x = 0; x < 96; ++x) {
      const int covered = alpha_at(solid, x, y);
      between += covered > 0 && covered < 255 ? 1 : 0;
      EXPECT_NEAR(alpha_at(cut, x, y), 255 - covered, 1) << "at " << x << ", " << y;  // 8 bits round twice
    }
  }
  EXPECT_GT(between, 100) << "the contour is smooth";
}

TEST_F(Holdout, LeavesWhatIsInFrontAlone) {
  const View v = view(64, 64, 60);
  const Layer ball = drawn(scene_of(toon(sphere(4), moved(0, 0, 4))), v);
  const Layer before =
      drawn(scene_of(toon(sphere(4), moved(0, 0, 4)), holdout(square(), moved(0, 0, 8) * scaled(6))), v);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) EXPECT_EQ(alpha_at(before, x, y), alpha_at(ball, x, y)) << "at " << x << ", " << y;
  }
}

TEST_F(Holdout, CutsLinesAsWell) {
  const View v = view(96, 96, 90);
  auto lined = [&] {
    passes::StyledObject styled = toon(sphere(4), moved(0, 0, 6));
    styled.passes.push_back(
        std::make_unique<outline::HullPass>(*styled.object, outline::HullOptions{.look = {.width_px = 4}}));
    return styled;
  };
  // The right half of the picture is hidden.
  const Layer cut = drawn(scene_of(lined(), holdout(square(), moved(3, 0, 3) * scaled(3))), v);
  for (int y = 0; y < 96; ++y) {
    for (int x = 49; x < 96; ++x) EXPECT_EQ(alpha_at(cut, x, y), 0) << "at " << x << ", " << y;
  }
  EXPECT_EQ(alpha_at(cut, 40, 48), 255);
}

// Any list stands for a region's here: what is asked is only whether it is taken.
TEST_F(Holdout, CoverOfARegionIsDrawnWhereItHasFewerTriangles) {
  const mesh::Mesh ball = sphere(2);
  const View v = view(64, 64, 60);
  passes::ObjectShape shape(ball, moved(0, 0, 4));
  const std::size_t whole = shape.look(v, picture_of(v)).front.size();
  EXPECT_FALSE(shape.last_look().cull_back_faces);
  std::vector<std::uint32_t> list(whole - 3);
  glm::dvec3 asked_for(0);
  passes::RegionKnowledge known;
  known.cover = [&](const glm::dvec3& eye) {
    asked_for = eye;
    return std::span<const std::uint32_t>(list);
  };
  shape.use_regions(known);
  const passes::Look& less = shape.look(v, picture_of(v));
  EXPECT_EQ(less.front.data(), list.data());
  EXPECT_TRUE(less.cull_back_faces);
  ASSERT_EQ(less.front_runs.size(), 1u);
  EXPECT_EQ(less.front_runs[0].index_count, list.size());
  EXPECT_EQ(asked_for, glm::dvec3(0, 0, -4)) << "the eye in the object's coordinates";
  list.resize(whole);
  EXPECT_EQ(shape.look(v, picture_of(v)).front.size(), whole);
  EXPECT_FALSE(shape.last_look().cull_back_faces) << "no fewer: the whole mesh's are taken";
  list.clear();
  EXPECT_EQ(shape.look(v, picture_of(v)).front.size(), whole) << "no region holds the eye";
}

}  // namespace
}  // namespace rinkaku::test
