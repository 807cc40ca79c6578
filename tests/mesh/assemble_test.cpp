#include "mesh/assemble.h"

#include <cmath>
#include <limits>
#include <set>

#include <glm/geometric.hpp>

#include "tests/mesh/shapes.h"

namespace rinkaku::mesh {
namespace {

using test::cube;
using test::one_part;
using test::sphere;
using test::square;

TEST(Assemble, CubeHasHardEdgesAndOnePointACorner) {
  const Mesh mesh = assemble(cube(), 60).mesh;
  EXPECT_EQ(mesh.positions.size(), 24u);
  EXPECT_EQ(mesh.point_count, 8u);
  for (std::size_t v = 0; v < mesh.normals.size(); ++v) {
    const glm::vec3 n = glm::abs(mesh.normals[v]);
    EXPECT_EQ(std::max({n.x, n.y, n.z}), 1.0f) << "a cube's normals run along the axes";
    EXPECT_GT(glm::dot(mesh.normals[v], mesh.positions[v]), 0.9f) << "and point outwards";
  }
}

TEST(Assemble, CubeBeyondItsRightAngleIsSmooth) {
  const Mesh mesh = assemble(cube(), 90).mesh;
  ASSERT_EQ(mesh.positions.size(), 8u);
  // The angle at a corner is a right one on each side, however it is cut into triangles.
  for (std::size_t v = 0; v < 8; ++v) {
    EXPECT_NEAR(glm::distance(mesh.normals[v], glm::normalize(mesh.positions[v])), 0, 1e-6);
  }
}

TEST(Assemble, SphereHasOneNormalAPoint) {
  const Mesh mesh = assemble(sphere(4), 60).mesh;
  EXPECT_EQ(mesh.triangles.size(), 2048u);
  EXPECT_EQ(mesh.positions.size(), mesh.point_count);
  for (std::size_t v = 0; v < mesh.normals.size(); ++v) {
    // Edges are about 0.1 radian long, and normals off by their square.
    EXPECT_LT(glm::distance(mesh.normals[v], mesh.positions[v]), 0.015);
    EXPECT_NEAR(glm::length(mesh.normals[v]), 1, 1e-6);
  }
}

TEST(Assemble, FacesWithoutASharedVertexAreWeldedByPosition) {
  Soup soup = sphere(3);
  Soup apart;
  for (const glm::uvec3& t : soup.triangles) {
    for (int c = 0; c < 3; ++c) {
      glm::vec3 p = soup.positions[t[c]];
      if (p.x == 0 && apart.positions.size() % 2 == 0) p.x = -0.0f;
      apart.positions.push_back(p);
    }
    const auto last = static_cast<std::uint32_t>(apart.positions.size());
    apart.triangles.emplace_back(last - 3, last - 2, last - 1);
  }
  const Mesh mesh = assemble(one_part(std::move(apart)), 60).mesh;
  EXPECT_EQ(mesh.positions.size(), soup.positions.size());
  EXPECT_EQ(mesh.point_count, soup.positions.size());
}

TEST(Assemble, TextureSeamSplitsVerticesButNotPoints) {
  Soup soup = square();
  soup.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  soup.triangles = {{0, 1, 2}, {3, 4, 5}};
  soup.uvs = {{0, 0}, {1, 0}, {1, 1}, {0.5f, 0}, {1, 1}, {0, 1}};  // one end of the diagonal differs
  const Mesh mesh = assemble(std::move(soup), 60).mesh;
  EXPECT_EQ(mesh.point_count, 4u);
  EXPECT_EQ(mesh.positions.size(), 5u);
  EXPECT_EQ(mesh.uvs.size(), 5u);
}

TEST(Assemble, DisagreeingWindingsAreShadedSmoothlyEachOnItsOwnSide) {
  Soup soup = square();
  std::swap(soup.triangles[1].y, soup.triangles[1].z);
  const Mesh mesh = assemble(std::move(soup), 60).mesh;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 own =
        glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
    for (int c = 0; c < 3; ++c) EXPECT_GT(glm::dot(mesh.normals[t[c]], own), 0);
  }
}

TEST(Assemble, FilesNormalsAreKeptAndMissingOnesComputed) {
  Soup soup = square();
  const glm::vec3 tilted = glm::normalize(glm::vec3(1, 0, 2));
  soup.normals = {tilted * 3.0f, glm::vec3(0), glm::vec3(std::nanf(""), 0, 0), tilted};
  const Mesh mesh = assemble(std::move(soup), 60).mesh;
  for (std::size_t v = 0; v < mesh.normals.size(); ++v) {
    const bool given = mesh.positions[v].x == 0;
    EXPECT_NEAR(glm::distance(mesh.normals[v], given ? tilted : glm::vec3(0, 0, 1)), 0, 1e-6);
  }
}

TEST(Assemble, BrokenTrianglesAreDroppedAndCounted) {
  Soup soup = square();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  soup.positions.insert(soup.positions.end(), {{nan, 0, 0}, {0, -inf, 0}, {0, 0, -0.0f}, {5, 5, 5}});
  soup.triangles.insert(soup.triangles.end(), {{0, 1, 4}, {0, 1, 5}, {0, 1, 99}, {0, 6, 1}, {2, 2, 1}});
  const auto [mesh, rig, dropped] = assemble(one_part(std::move(soup)), 60);
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(dropped.non_finite, 2u);
  EXPECT_EQ(dropped.bad_index, 1u);
  EXPECT_EQ(dropped.collapsed, 2u) << "0 and 6 are one point, as 0 and -0 are equal; 2 twice";
  EXPECT_EQ(dropped.unused_vertices, 1u);
}

TEST(Assemble, PartsKeepTheirTrianglesAndEmptyOnesGo) {
  Soup soup = sphere(2);
  Part first{"first", 0, 50, 0};
  Part hollow{"hollow", 50, 0, 0};
  Part rest{"rest", 50, static_cast<std::uint32_t>(soup.triangles.size()) - 50, 1};
  soup.parts = {first, hollow, rest};
  soup.materials.resize(2);
  std::multiset<float> heights;
  for (int t = 0; t < 50; ++t) {
    for (int c = 0; c < 3; ++c) heights.insert(soup.positions[soup.triangles[static_cast<std::size_t>(t)][c]].z);
  }
  const Mesh mesh = assemble(std::move(soup), 60).mesh;
  ASSERT_EQ(mesh.parts.size(), 2u);
  EXPECT_EQ(mesh.parts[0].name, "first");
  EXPECT_EQ(mesh.parts[1].name, "rest");
  EXPECT_EQ(mesh.parts[1].first_triangle, 50u);
  std::multiset<float> after;
  for (int t = 0; t < 50; ++t) {
    for (int c = 0; c < 3; ++c) after.insert(mesh.positions[mesh.triangles[static_cast<std::size_t>(t)][c]].z);
  }
  EXPECT_EQ(heights, after) << "the order within a part may change, what is in it may not";
}

TEST(Assemble, ZeroAreaTrianglesGetNormalsOfTheirNeighbours) {
  Soup soup;  // a square whose diagonal holds a triangle without area
  soup.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5f, 0.5f, 0}};
  soup.triangles = {{0, 1, 2}, {0, 2, 4}, {0, 4, 3}, {4, 2, 3}};
  const Mesh mesh = assemble(one_part(std::move(soup)), 60).mesh;
  EXPECT_EQ(mesh.positions.size(), 5u);
  for (const glm::vec3& n : mesh.normals) EXPECT_NEAR(n.z, 1, 1e-6);
}

TEST(Assemble, TinyAndHugeMeshesKeepTheirNormals) {
  for (const float size : {1e-15f, 1e-6f, 1e6f, 1e15f}) {
    Soup soup = sphere(2);
    for (glm::vec3& p : soup.positions) p *= size;
    const Mesh mesh = assemble(std::move(soup), 60).mesh;
    EXPECT_EQ(mesh.positions.size(), mesh.point_count) << size;
    for (std::size_t v = 0; v < mesh.normals.size(); ++v) {
      EXPECT_LT(glm::distance(mesh.normals[v], mesh.positions[v] / size), 0.1) << size;
    }
  }
}

}  // namespace
}  // namespace rinkaku::mesh
