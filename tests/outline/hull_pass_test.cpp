#include "outline/pass/hull_pass.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/outline/lined.h"
#include "tests/pipeline/passes/drawing.h"
#include "tests/pipeline/passes/gl_test.h"
#include "tests/pipeline/passes/shapes.h"

namespace rinkaku::test {
namespace {

using passes::Layer;
using passes::View;

class Hull : public GlTest {};

// A ball of a given radius in pixels in the middle of the picture, at a distance.
glm::dmat4 ball_place(const View& v, double radius_px, double distance_m) {
  const double radius = distance_m * radius_px / std::hypot(radius_px, v.camera.fx_px);
  // Not on the pixel grid's own symmetry.
  const double px = distance_m / v.camera.fx_px;
  return moved(0.23 * px, -0.31 * px, distance_m) * scaled(radius);
}

TEST_F(Hull, RingHasItsWidth) {
  const View v = view(400, 400, 800);
  const mesh::Mesh ball = sphere(5);
  double worst = 0;
  for (double radius_px : {12.0, 45.0, 110.0}) {
    for (double width_px : {1.0, 1.5, 3.0, 8.0}) {
      const Layer layer = drawn(scene_of(lined(ball, ball_place(v, radius_px, 2), width_px)), v);
      const double body = channel_px(layer, 1);  // green is the body's alone
      const double ring = area_px(layer) - body;
      const double pi = std::numbers::pi;
      const double wish = pi * ((radius_px + width_px) * (radius_px + width_px) - radius_px * radius_px);
      worst = std::max(worst, std::abs(ring / wish - 1));
      // Both edges are within some hundredths of a pixel.
      EXPECT_NEAR(ring / wish, 1, 0.02) << radius_px << " px, line " << width_px;
      EXPECT_NEAR(body / (pi * radius_px * radius_px), 1, 0.005) << radius_px << " px, line " << width_px;
    }
  }
  RecordProperty("worst_ring_error_percent", std::to_string(worst * 100));
}

TEST_F(Hull, LineThinnerThanAPixelIsAsFaintAsItIsThin) {
  const View v = view(240, 240, 800);
  const mesh::Mesh ball = sphere(5);
  double worst = 0;
  for (double width_px : {0.1, 0.25, 0.5, 0.51, 0.75, 0.99}) {
    const Layer layer = drawn(scene_of(lined(ball, ball_place(v, 80, 2), width_px)), v);
    const double ring = area_px(layer) - channel_px(layer, 1);
    const double wish = std::numbers::pi * ((80 + width_px) * (80 + width_px) - 80.0 * 80.0);
    worst = std::max(worst, std::abs(ring - wish) / 503);
    // In pixels of width. It is drawn a pixel wide, so a little of it lies farther out (1/160 more); 8 bits round.
    EXPECT_NEAR((ring - wish) / 503, 0, 0.02) << width_px;
  }
  RecordProperty("worst_thin_line_error_px", std::to_string(worst));
}

TEST_F(Hull, WidthIsTheSameAtAnyDistanceAndScale) {
  const View v = view(240, 240, 800);
  const mesh::Mesh ball = sphere(5);
  const double near = area_px(drawn(scene_of(lined(ball, ball_place(v, 60, 0.5), 3)), v));
  for (double distance : {2.0, 50.0, 900.0}) {
    // The same picture by construction; only the depth buffer's and the matrices' floats differ.
    EXPECT_NEAR(area_px(drawn(scene_of(lined(ball, ball_place(v, 60, distance), 3)), v)) / near, 1, 0.001) << distance;
  }
}

// In a convex shape's picture, each row's opaque pixels are one run: a line with gaps would break it.
TEST_F(Hull, LineHasNoGapsAtHardEdges) {
  const View v = view(160, 160, 300);
  for (const mesh::Mesh& mesh : {cube(), tetrahedron(), sphere(0), sphere(2)}) {
    for (int i = 0; i < 10; ++i) {
      const glm::dmat4 place =
          moved(0.01, 0.02, 2) * glm::rotate(glm::dmat4(1), 0.1 + i * 0.63, {0.4, 1, 0.2}) * scaled(0.2);
      const Layer layer = drawn(scene_of(lined(mesh, place, 4)), v);
      for (int y = layer.rect.y_px; y < layer.rect.bottom_px(); ++y) {
        int runs = 0;
        for (int x = layer.rect.x_px; x < layer.rect.right_px(); ++x) {
          runs += at(layer, x, y)[3] >= 250 && at(layer, x - 1, y)[3] < 250;
        }
        ASSERT_LE(runs, 1) << mesh.triangles.size() << " triangles, turn " << i << ", row " << y;
      }
    }
  }
}

TEST_F(Hull, NearerLineCoversWhatIsBehindAndIsCoveredByWhatIsBefore) {
  const View v = view(200, 160, 400);
  const mesh::Mesh ball = sphere(5);
  // A near ball to the left, a far one to the right, overlapping; lines red and blue.
  const Layer layer = drawn(scene_of(lined(ball, moved(0.2, 0, 3) * scaled(0.4), 4, {0, 0, 1}),
                                     lined(ball, moved(-0.1, 0, 2) * scaled(0.2), 4, {1, 0, 0})),
                            v);
  const SeenSphere near = seen_sphere(v.camera, {-0.1, 0, 2}, 0.2), far = seen_sphere(v.camera, {0.2, 0, 3}, 0.4);
  const double near_r = std::sqrt(near.area_px / std::numbers::pi), far_r = std::sqrt(far.area_px / std::numbers::pi);
  int near_line = 0, far_line = 0;
  for (int y = 0; y < 160; ++y) {
    for (int x = 0; x < 200; ++x) {
      const double from_near = glm::length(glm::dvec2(x, y) - near.centre_px) - near_r;
      const double from_far = glm::length(glm::dvec2(x, y) - far.centre_px) - far_r;
      // A pixel and a half within each line: perspective makes the circles ellipses, by up to half a pixel here.
      if (from_near > 1.5 && from_near < 2.5) {
        ASSERT_EQ(at(layer, x, y), (Rgba{255, 0, 0, 255})) << x << ", " << y;
        ++near_line;
      } else if (from_near < -1.5) {
        ASSERT_EQ(at(layer, x, y), (Rgba{255, 255, 255, 255})) << x << ", " << y;
      } else if (from_near > 5.5 && from_far > 1.5 && from_far < 2.5) {
        ASSERT_EQ(at(layer, x, y), (Rgba{0, 0, 255, 255})) << x << ", " << y;
        ++far_line;
      }
    }
  }
  EXPECT_GT(near_line, 200);
  EXPECT_GT(far_line, 150);
}

TEST_F(Hull, ObjectHidingItselfShowsALineThere) {
  const View v = view(120, 120, 200);
  mesh::Mesh two = cube();
  append(two, cube(), {1.6f, 0.3f, 4});
  const Layer layer = drawn(scene_of(lined(two, moved(-0.05, 0, 2) * scaled(0.15), 3)), v);
  // From the near cube's middle to the right: white, the line, the far cube's white, its line.
  std::string run;
  for (int x = 55; x < 120; ++x) {
    const Rgba c = at(layer, x, 60);
    if (c[3] != 255 || (c[1] != 0 && c[1] != 255)) continue;
    const char seen = c[1] == 255 ? 'w' : 'r';
    if (run.empty() || run.back() != seen) run += seen;
  }
  EXPECT_EQ(run, "wrwr");
}

TEST_F(Hull, LayerHoldsTheWholeLine) {
  const View v = view(240, 240, 400);
  for (double width_px : {0.3, 1.0, 3.0, 8.0, 20.0}) {
    for (const mesh::Mesh& mesh : {sphere(3), cube(), tetrahedron()}) {
      const Layer layer = drawn(scene_of(lined(mesh, moved(0.01, 0, 2) * scaled(0.2), width_px)), v);
      const passes::PixelRect& r = layer.rect;
      int outermost = 0;
      for (int x = r.x_px; x < r.right_px(); ++x) {
        outermost += at(layer, x, r.y_px)[3] + at(layer, x, r.bottom_px() - 1)[3];
      }
      for (int y = r.y_px; y < r.bottom_px(); ++y) {
        outermost += at(layer, r.x_px, y)[3] + at(layer, r.right_px() - 1, y)[3];
      }
      EXPECT_EQ(outermost, 0) << width_px;
    }
  }
}

TEST_F(Hull, OpenSquareHasALineAllAround) {
  const View v = view(160, 160, 300);
  const Layer layer = drawn(scene_of(lined(square(), moved(0.003, 0.001, 3), 6)), v);
  // 200 pixels would not fit; it is 2 / 3 * 300 = 200 wide: drawn again smaller.
  const Layer small = drawn(scene_of(lined(square(), moved(0.003, 0.001, 3) * scaled(0.5), 6)), v);
  EXPECT_EQ(area_px(layer), 160 * 160);
  for (const glm::ivec2 beside : {glm::ivec2(79, 27), {79, 132}, {27, 79}, {132, 79}}) {
    EXPECT_EQ(at(small, beside.x, beside.y), (Rgba{255, 0, 0, 255})) << beside.x << ", " << beside.y;
  }
  EXPECT_EQ(at(small, 79, 79), (Rgba{255, 255, 255, 255}));
}

TEST_F(Hull, NearPlaneAndEyeInsideAreNoTrouble) {
  const View v = view(64, 48, 50);
  for (const mesh::Mesh& mesh : {sphere(3), cube(), square()}) {
    for (const glm::dmat4& place : {scaled(3), moved(0.1, 0.1, 0.2) * scaled(0.5), moved(0, 0.2, 0) * scaled(40),
                                    moved(0.2, 0, 0.001) * scaled(0.1)}) {
      const Layer layer = drawn(scene_of(lined(mesh, place, 3)), v);
      EXPECT_EQ(layer.rect, intersection(layer.rect, picture_of(v)));
    }
  }
}

// Two: of the line, and of what lies behind it.
TEST_F(Hull, ProgramsAreMadeOnlyForObjectsWithALine) {
  const mesh::Mesh mesh = cube();
  gl::Made before = gl::made();
  const passes::StyledObject plain = toon(mesh, glm::dmat4(1));
  const int without = gl::made().programs - before.programs;
  before = gl::made();
  const passes::StyledObject with_line = lined(mesh, glm::dmat4(1), 3);
  EXPECT_EQ(gl::made().programs - before.programs, without + 2);
  before = gl::made();
  const passes::StyledObject upright = lined(mesh, glm::dmat4(1), outline::HullOptions{.lean = 0});
  EXPECT_EQ(gl::made().programs - before.programs, without + 1);
}

}  // namespace
}  // namespace rinkaku::test
