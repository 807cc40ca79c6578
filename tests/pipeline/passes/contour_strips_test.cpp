#include "pipeline/passes/contour_strips.h"

#include <map>

#include <gtest/gtest.h>

#include "tests/pipeline/passes/shapes.h"

namespace rinkaku::test {
namespace {

using passes::ContourStrips;
using passes::ShapeVertex;

std::vector<ShapeVertex> vertices_of(const mesh::Mesh& mesh) {
  std::vector<ShapeVertex> all(mesh.positions.size());
  for (std::size_t v = 0; v < all.size(); ++v) {
    all[v].position = mesh.positions[v];
    for (int k = 0; k < 3; ++k) all[v].normal[k] = static_cast<std::int16_t>(std::lround(mesh.normals[v][k] * 32767));
  }
  return all;
}

std::array<float, 3> key(const glm::vec3& p) { return {p.x, p.y, p.z}; }

// On a closed surface every contour edge leads on to another: each end belongs to two quads.
TEST(ContourStrips, QuadsOfAClosedSurfaceJoinIntoLoops) {
  const mesh::Mesh ball = sphere(3);
  const mesh::Topology topology = mesh::topology(ball);
  mesh::ContourFinder finder(ball, topology);
  ContourStrips strips(ball, topology, false);
  strips.collect(finder.find(glm::dvec3(2, 1, 3)), vertices_of(ball));
  ASSERT_EQ(strips.runs().size(), 1u);
  ASSERT_EQ(strips.indices().size() % 6, 0u);
  ASSERT_EQ(strips.vertices().size() * 6, strips.indices().size() * 4);
  std::map<std::array<float, 3>, int> ends;
  for (std::size_t q = 0; q < strips.vertices().size(); q += 4) {
    for (std::size_t k : {0u, 1u}) {
      const ShapeVertex &edge = strips.vertices()[q + k], &rim = strips.vertices()[q + k + 2];
      EXPECT_EQ(key(edge.position), key(rim.position));
      EXPECT_EQ(edge.outline_normal[3], 0);
      EXPECT_EQ(rim.outline_normal[3], 32767);
      ++ends[key(edge.position)];
    }
  }
  EXPECT_GT(ends.size(), 10u);
  for (const auto& [point, quads] : ends) EXPECT_EQ(quads, 2);
}

TEST(ContourStrips, ABorderSeenFromBehindHasItsNormalsTurned) {
  const mesh::Mesh open = square();
  const mesh::Topology topology = mesh::topology(open);
  mesh::ContourFinder finder(open, topology);
  ContourStrips strips(open, topology, true);
  const glm::vec3 normal = open.normals[0];
  for (double side : {1.0, -1.0}) {
    strips.collect(finder.find(glm::dvec3(open.positions[0]) + side * 3.0 * glm::dvec3(normal)), vertices_of(open));
    ASSERT_EQ(strips.vertices().size(), 16u);  // four borders
    for (const ShapeVertex& v : strips.vertices()) {
      const glm::vec3 n(v.normal[0], v.normal[1], v.normal[2]);
      EXPECT_GT(glm::dot(n, normal) * side, 0);
    }
  }
}

TEST(ContourStrips, EachPartHasOneRun) {
  mesh::Mesh ball = sphere(3);
  mesh::Part second = ball.parts[0];
  const auto half = static_cast<std::uint32_t>(ball.triangles.size() / 2);
  ball.parts[0].triangle_count = half;
  second.first_triangle = half, second.triangle_count -= half;
  ball.parts.push_back(second);
  const mesh::Topology topology = mesh::topology(ball);
  mesh::ContourFinder finder(ball, topology);
  ContourStrips strips(ball, topology, false);
  strips.collect(finder.find(glm::dvec3(1, -4, 2)), vertices_of(ball));
  ASSERT_EQ(strips.runs().size(), 2u);
  EXPECT_EQ(strips.runs()[0].part, 0u);
  EXPECT_EQ(strips.runs()[1].part, 1u);
  EXPECT_EQ(strips.runs()[0].index_count, strips.runs()[1].first_index);
  EXPECT_EQ(strips.runs()[1].first_index + strips.runs()[1].index_count, strips.indices().size());
}

}  // namespace
}  // namespace rinkaku::test
