#include "mesh/levels.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/mesh/shapes.h"

namespace rinkaku::test {
namespace {

using mesh::Level;

TEST(Levels, HalveDownToAFewHundredTriangles) {
  const mesh::Mesh ball = mesh::assemble(sphere(5), 60).mesh;  // 8,192 triangles
  const std::vector<Level> all = mesh::levels(ball);
  ASSERT_EQ(all.size(), 4u);  // 4,096, 2,048, 1,024, 512
  std::size_t before = ball.triangles.size();
  double error = 0;
  for (const Level& level : all) {
    EXPECT_LE(level.triangles.size(), before / 2 + before / 20);  // collapses take two triangles at a time
    EXPECT_GT(level.error, error);
    before = level.triangles.size();
    error = level.error;
    for (const glm::uvec3& t : level.triangles) {
      for (int k = 0; k < 3; ++k) ASSERT_LT(t[k], ball.positions.size());
    }
  }
}

// Vertices stay on the unit ball, so a triangle is farthest from it at its middle.
TEST(Levels, SurfaceLiesWithinTheStatedErrorOfTheBall) {
  const mesh::Mesh ball = mesh::assemble(sphere(6), 60).mesh;
  const std::vector<Level> all = mesh::levels(ball);
  ASSERT_FALSE(all.empty());
  for (const Level& level : all) {
    double sum = 0;
    for (const glm::uvec3& t : level.triangles) {
      const glm::dvec3 middle =
          (glm::dvec3(ball.positions[t.x]) + glm::dvec3(ball.positions[t.y]) + glm::dvec3(ball.positions[t.z])) / 3.0;
      sum += 1 - glm::length(middle);
    }
    // Quadrics weigh squared distances by area, so the error is of the kind of a mean, not of a maximum; it is measured
    // against the mesh that was simplified, which is itself inside the ball.
    EXPECT_LT(sum / static_cast<double>(level.triangles.size()), 2 * level.error + 1e-3);
  }
}

TEST(Levels, TexturedPartsAndColouredMeshesStayWhole) {
  mesh::Mesh ball = mesh::assemble(sphere(5), 60).mesh;
  ball.materials[0].texture = 0;
  EXPECT_TRUE(mesh::levels(ball).empty());
  ball.materials[0].texture = -1;
  ball.colours.assign(ball.positions.size(), glm::vec4(1));
  EXPECT_TRUE(mesh::levels(ball).empty());
}

TEST(Levels, PartsMeetWithoutCracks) {
  mesh::Mesh ball = mesh::assemble(sphere(5), 60).mesh;
  // Two halves by the order of triangles, each its own part.
  const auto half = static_cast<std::uint32_t>(ball.triangles.size() / 2);
  mesh::Part second = ball.parts[0];
  ball.parts[0].triangle_count = half;
  second.first_triangle = half;
  second.triangle_count -= half;
  ball.parts.push_back(second);
  for (const Level& level : mesh::levels(ball)) {
    ASSERT_EQ(level.parts.size(), 2u);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const glm::uvec3& t : level.triangles) {
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t a = ball.welded[t[k]], b = ball.welded[t[(k + 1) % 3]];
        ++edges[std::minmax(a, b)];
      }
    }
    for (const auto& [edge, faces] : edges) ASSERT_EQ(faces, 2);
  }
}

}  // namespace
}  // namespace rinkaku::test
