#include "outline/strokes/drawn_lines.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/pipeline/passes/shapes.h"

namespace rinkaku::outline {
namespace {

glm::dvec3 position(const mesh::Mesh& mesh, const SurfacePlace& place) {
  const glm::uvec3& t = mesh.triangles[place.triangle];
  const double b = place.b, c = place.c;
  return (1 - b - c) * glm::dvec3(mesh.positions[t.x]) + b * glm::dvec3(mesh.positions[t.y]) +
         c * glm::dvec3(mesh.positions[t.z]);
}

// From (0, 0, -4) along z, with a focal length of 100 pixels.
constexpr double focal_px = 100;
const glm::dvec3 eye(0, 0, -4);
std::optional<glm::dvec3> ray(const glm::dvec2& px) { return glm::dvec3(px / focal_px, 1); }

TEST(DrawnLines, RayMeetsTheNearSideOfABall) {
  const mesh::Mesh ball = test::sphere(5);
  const auto hit = first_hit(ball, eye, {0.02, 0.01, 1});
  ASSERT_TRUE(hit);
  const glm::dvec3 at = position(ball, hit->place);
  EXPECT_NEAR(glm::length(at), 1, 1e-3);  // triangles lie a little within the ball
  EXPECT_LT(at.z, -0.99);
  EXPECT_LT(glm::length(at - (eye + hit->distance * glm::dvec3(0.02, 0.01, 1))), 1e-6);  // weights are floats
  EXPECT_FALSE(first_hit(ball, eye, {1, 0, 1}));
  EXPECT_FALSE(first_hit(ball, eye, {0, 0, -1})) << "behind the eye";
}

TEST(DrawnLines, LineIsSeenWhereItWasDrawn) {
  const mesh::Mesh ball = test::sphere(4);
  const std::vector<std::vector<glm::dvec2>> lines = {{{-10, -5}, {0, 8}, {12, 3}}};
  const std::vector<DrawnLine> laid = lay_onto(ball, lines, eye, ray);
  ASSERT_EQ(laid.size(), 1u);
  EXPECT_GE(laid[0].size(), (std::hypot(10, 13) + std::hypot(12, 5)) / 2) << "a place at least every two pixels";
  for (const SurfacePlace& place : laid[0]) {
    const glm::dvec3 at = position(ball, place) - eye;
    const glm::dvec2 px = focal_px * glm::dvec2(at) / at.z;
    double nearest = 1e9;
    for (int i = 0; i < 2; ++i) {
      const glm::dvec2 a = lines[0][i], way = lines[0][i + 1] - a;
      const double t = std::clamp(glm::dot(px - a, way) / glm::dot(way, way), 0.0, 1.0);
      nearest = std::min(nearest, glm::length(px - a - t * way));
    }
    EXPECT_LT(nearest, 1e-3);
  }
}

TEST(DrawnLines, LineIsPartedWhereItLeavesTheMeshOrJumpsToAnotherPart) {
  mesh::Mesh two = test::square();               // at z = 0, seen from -50 to 50 pixels / 2
  test::append(two, test::square(), {1, 0, 6});  // far behind it, to the right
  // Across the near square, onto the far one, and off it.
  const std::vector<DrawnLine> laid =
      lay_onto(two, std::vector<std::vector<glm::dvec2>>{{{-40, 1}, {60, 1}}}, eye, ray);
  ASSERT_EQ(laid.size(), 1u) << "the far square is hidden by the near one up to 20 px";
  // The near one is seen to 25 px, the far one, ten from the eye, from 0 to 20.
  mesh::Mesh beside = test::square();
  test::append(beside, test::square(), {4, 0, 6});  // from 30 to 50 px
  EXPECT_EQ(lay_onto(beside, std::vector<std::vector<glm::dvec2>>{{{-40, 1}, {60, 1}}}, eye, ray).size(), 2u);
  mesh::Mesh touching = test::square();
  test::append(touching, test::square(), {3, 0, 6});  // from 20 to 40 px: the line jumps from one to the other
  const auto jumped = lay_onto(touching, std::vector<std::vector<glm::dvec2>>{{{-40, 1}, {60, 1}}}, eye, ray);
  ASSERT_EQ(jumped.size(), 2u);
  EXPECT_LT(jumped[0].front().triangle, 2u);
  EXPECT_GE(jumped[1].front().triangle, 2u);
}

TEST(DrawnLines, RaysThatLookNowhereAndLinesBesideTheMeshGiveNothing) {
  const mesh::Mesh ball = test::sphere(2);
  const auto nowhere = [](const glm::dvec2&) { return std::optional<glm::dvec3>(); };
  const std::vector<std::vector<glm::dvec2>> lines = {{{0, 0}, {10, 0}}};
  EXPECT_TRUE(lay_onto(ball, lines, eye, nowhere).empty());
  EXPECT_TRUE(lay_onto(ball, std::vector<std::vector<glm::dvec2>>{{{200, 0}, {300, 0}}}, eye, ray).empty());
}

}  // namespace
}  // namespace rinkaku::outline
