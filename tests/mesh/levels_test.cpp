#include "mesh/levels.h"

#include <algorithm>
#include <array>
#include <set>

#include <gtest/gtest.h>

#include "tests/mesh/shapes.h"

namespace rinkaku::test {
namespace {

using mesh::Level;

std::vector<Level> all_levels(const mesh::Mesh& mesh, std::span<const std::uint8_t> kept = {}) {
  const mesh::Levels levels(mesh, kept);
  std::vector<Level> all;
  for (std::size_t i = 0; i < levels.count(); ++i) {
    all.push_back(levels.make(i));
    EXPECT_LE(all.back().error, levels.most_error(i) * 1.001);  // rounded to float inside
  }
  return all;
}

TEST(Levels, GetCoarserAsTheErrorGrows) {
  const mesh::Mesh ball = mesh::assemble(sphere(5), 60).mesh;  // 8,192 triangles
  const std::vector<Level> all = all_levels(ball);
  ASSERT_GE(all.size(), 4u);
  std::size_t before = ball.triangles.size();
  double error = 0;
  for (const Level& level : all) {
    EXPECT_LE(level.triangles.size(), before);
    EXPECT_GE(level.error, error);
    before = level.triangles.size();
    error = level.error;
    for (const glm::uvec3& t : level.triangles) {
      for (int k = 0; k < 3; ++k) ASSERT_LT(t[k], ball.positions.size());
    }
  }
  // A ball of N even triangles lies about 3.6 / N from its hull inside; an error of 1 % of its width leaves a few
  // hundred.
  EXPECT_LT(before, 1000u);
}

// Vertices stay on the unit ball, so a triangle is farthest from it at its middle.
TEST(Levels, SurfaceLiesWithinTheStatedErrorOfTheBall) {
  const mesh::Mesh ball = mesh::assemble(sphere(6), 60).mesh;
  const std::vector<Level> all = all_levels(ball);
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
  EXPECT_TRUE(all_levels(ball).empty());
  ball.materials[0].texture = -1;
  ball.colours.assign(ball.positions.size(), glm::vec4(1));
  EXPECT_TRUE(all_levels(ball).empty());
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
  for (const Level& level : all_levels(ball)) {
    ASSERT_EQ(level.parts.size(), 4u);  // each part's kept triangles, here none, and the rest
    EXPECT_EQ(level.parts[0].triangle_count + level.parts[2].triangle_count, 0u);
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

TEST(Levels, KeptTrianglesStay) {
  const mesh::Mesh ball = mesh::assemble(sphere(5), 60).mesh;
  std::vector<std::uint8_t> kept(ball.triangles.size());
  std::set<std::array<std::uint32_t, 3>> wanted;
  for (std::size_t f = 0; f < kept.size(); ++f) {
    const glm::uvec3& t = ball.triangles[f];
    const glm::vec3 middle = (ball.positions[t.x] + ball.positions[t.y] + ball.positions[t.z]) / 3.0f;
    if (std::abs(middle.z) > 0.1f) continue;  // a belt
    kept[f] = 1;
    wanted.insert({t.x, t.y, t.z});
  }
  const std::vector<Level> all = all_levels(ball, kept);
  ASSERT_GE(all.size(), 3u);
  for (const Level& level : all) {
    ASSERT_EQ(level.parts.size(), 2u);
    std::set<std::array<std::uint32_t, 3>> found;
    for (std::uint32_t f = 0; f < level.parts[0].triangle_count; ++f) {
      const glm::uvec3& t = level.triangles[level.parts[0].first_triangle + f];
      found.insert({t.x, t.y, t.z});
    }
    EXPECT_EQ(found, wanted);
  }
  EXPECT_LT(all.back().triangles.size() - wanted.size(), ball.triangles.size() / 8) << "the rest gets coarser";
}

}  // namespace
}  // namespace rinkaku::test
