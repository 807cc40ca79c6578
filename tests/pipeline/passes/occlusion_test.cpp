// Which of several surfaces is seen.

#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "tests/pipeline/passes/drawing.h"
#include "tests/pipeline/passes/gl_test.h"
#include "tests/pipeline/passes/shapes.h"

namespace rinkaku::test {
namespace {

using passes::Layer;
using passes::View;

class Occlusion : public GlTest {};

const glm::vec4 red{1, 0, 0, 1}, green{0, 1, 0, 1}, blue{0, 0, 1, 1};

struct Ball {
  glm::dvec3 centre;
  double radius;
};

// By how many pixels a pixel's ray passes inside a ball's outline; how far along it (z of 1 a step) the ball begins.
struct Hit {
  double inside_px;
  double z;
};
Hit hit(const Ball& ball, const glm::dvec3& ray, double focal_px) {
  const double a = glm::dot(ray, ray), b = glm::dot(ray, ball.centre);
  const double c = glm::dot(ball.centre, ball.centre) - ball.radius * ball.radius;
  const double nearest = glm::length(ball.centre - ray * (b / a));
  const double under_root = b * b - a * c;
  return {(ball.radius - nearest) * focal_px / ball.centre.z, under_root > 0 ? (b - std::sqrt(under_root)) / a : 1e9};
}

// What a pixel shows: nothing, the first ball or the second.
Rgba truth(const View& v, const Ball& first, const Ball& second, double x, double y) {
  const glm::dvec3 ray(to_normalised(v.camera, {x, y}), 1);
  const Hit a = hit(first, ray, v.camera.fx_px), b = hit(second, ray, v.camera.fx_px);
  if (a.inside_px > 0 && a.z < b.z) return {255, 0, 0, 255};
  if (b.inside_px > 0) return {0, 0, 255, 255};
  return {};
}

// Checks every pixel but those within 1.5 pixels of a border between what is seen: there edges are smoothed, and
// surfaces are pulled in by half a pixel.
void expect_nearest_ball_seen(const Layer& layer, const View& v, const Ball& first, const Ball& second) {
  int checked = 0;
  for (int y = 0; y < v.camera.height_px; ++y) {
    for (int x = 0; x < v.camera.width_px; ++x) {
      const Rgba wish = truth(v, first, second, x, y);
      bool at_border = false;
      for (int k = 0; k < 9; ++k) {
        at_border = at_border || truth(v, first, second, x + (k % 3 - 1) * 1.5, y + (k / 3 - 1) * 1.5) != wish;
      }
      if (at_border) continue;
      ASSERT_EQ(at(layer, x, y), wish) << x << ", " << y;
      ++checked;
    }
  }
  EXPECT_GT(checked, v.camera.width_px * v.camera.height_px * 9 / 10);
}

glm::dmat4 place(const Ball& ball) { return moved(ball.centre.x, ball.centre.y, ball.centre.z) * scaled(ball.radius); }

TEST_F(Occlusion, NearerBallIsSeenWhateverTheOrder) {
  const View v = view(320, 240, 300);
  const mesh::Mesh red_ball = sphere(5, red), blue_ball = sphere(5, blue);
  const std::pair<Ball, Ball> scenes[] = {
      {{{-0.2, 0, 2}, 0.4}, {{0.2, 0.1, 2.4}, 0.5}},  // one before the other
      {{{0.1, 0, 2}, 0.5}, {{0, -0.05, 2.1}, 0.5}},   // through one another
      {{{0, 0, 2}, 0.2}, {{0, 0, 3}, 0.9}},           // a small one before a large one
      {{{0, 0, 2.2}, 0.5}, {{0.3, 0.1, 2.0}, 0.4}},   // the nearer centre, but not everywhere nearer
  };
  for (const auto& [a, b] : scenes) {
    const Layer one = drawn(scene_of(toon(red_ball, place(a)), toon(blue_ball, place(b))), v);
    const Layer other = drawn(scene_of(toon(blue_ball, place(b)), toon(red_ball, place(a))), v);
    expect_nearest_ball_seen(one, v, a, b);
    EXPECT_EQ(one.rect, other.rect);
    EXPECT_TRUE(one.rgba == other.rgba);
  }
}

// Where one covers the other entirely, the pair is covered as the union: no light fringe at the inner contour.
TEST_F(Occlusion, ContourBeforeAnotherObjectStaysOpaque) {
  const View v = view(320, 240, 300);
  const Ball small{{0.003, 0.001, 2}, 0.2}, large{{0, 0, 3}, 0.9};
  const Layer layer = drawn(scene_of(toon(sphere(5, red), place(small)), toon(sphere(5, blue), place(large))), v);
  int mixed = 0;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      const glm::dvec3 ray(to_normalised(v.camera, {x, y}), 1);
      if (hit(large, ray, v.camera.fx_px).inside_px < 2) continue;
      const Rgba colour = at(layer, x, y);
      ASSERT_EQ(colour[3], 255) << x << ", " << y;
      ASSERT_NEAR(colour[0] + colour[2], 255, 2);  // two roundings
      mixed += colour[0] > 5 && colour[2] > 5;
    }
  }
  EXPECT_GT(mixed, 120);  // the edge of a circle of 190 pixels' length is smooth
}

// Two squares that overlap, `apart` metres one behind the other and turned away by `turn`. One mesh, so that the order
// in which they are drawn is the given one.
Rgba seen_of_two_squares(double distance, double apart, double turn, bool far_first, glm::ivec2 pixel) {
  const View v = view(64, 64, 200);
  // Sizes in the object's units: the squares are 0.3 of the distance wide, the gap is in their own units.
  const double unit = distance * 0.15;
  const float gap = static_cast<float>(apart / unit);
  mesh::Mesh both = square(far_first ? blue : red);
  if (!far_first) {
    append(both, square(blue), {0, 0, gap});
  } else {
    both.positions.clear(), both.normals.clear(), both.uvs.clear(), both.welded.clear(), both.triangles.clear();
    both.parts.clear(), both.materials.clear(), both.point_count = 0;
    append(both, square(blue), {0, 0, gap});
    append(both, square(red), {0, 0, 0});
  }
  const glm::dmat4 place = moved(0, 0, distance) * glm::rotate(glm::dmat4(1), turn, {0.6, 0.8, 0}) * scaled(unit);
  return at(drawn(scene_of(toon(both, place)), v), pixel.x, pixel.y);
}

TEST_F(Occlusion, OneMillimetreIsToldApartAtTenMetresAndOneMetreAtAKilometre) {
  const std::pair<double, double> cases[] = {{0.1, 0.0001}, {1, 0.0005}, {10, 0.001}, {100, 0.05}, {1000, 1}};
  for (const auto& [distance, apart] : cases) {
    for (double turn : {0.0, 0.5, -0.9}) {
      for (bool far_first : {false, true}) {
        for (const glm::ivec2 pixel : {glm::ivec2(32, 32), {26, 30}, {35, 37}, {31, 24}}) {
          EXPECT_EQ(seen_of_two_squares(distance, apart, turn, far_first, pixel), (Rgba{255, 0, 0, 255}))
              << apart << " m at " << distance << " m, turned by " << turn << (far_first ? ", far first" : "");
        }
      }
    }
  }
}

TEST_F(Occlusion, TwoObjectsAMillimetreApartAreToldApart) {
  const View v = view(64, 64, 200);
  for (bool far_first : {false, true}) {
    auto near = toon(square(red), moved(0, 0, 10)), far = toon(square(blue), moved(0.2, 0, 10.001));
    const Layer layer = far_first ? drawn(scene_of(std::move(far), std::move(near)), v)
                                  : drawn(scene_of(std::move(near), std::move(far)), v);
    for (int y = 20; y < 44; ++y) {
      for (int x = 20; x < 44; ++x) ASSERT_EQ(at(layer, x, y), (Rgba{255, 0, 0, 255})) << x << ", " << y;
    }
  }
}

// A ring seen from the side hides its own far half.
TEST_F(Occlusion, MeshHidesItself) {
  const View v = view(64, 64, 200);
  mesh::Mesh row = cube(red);
  append(row, cube(blue), {0, 0, 4});
  append(row, cube(green), {0, 0, -4});
  const Layer layer = drawn(scene_of(toon(row, moved(0, 0, 2) * scaled(0.1))), v);
  for (int y = 24; y < 40; ++y) {
    for (int x = 24; x < 40; ++x) ASSERT_EQ(at(layer, x, y), (Rgba{0, 255, 0, 255}));
  }
}

}  // namespace
}  // namespace rinkaku::test
