// Curvature of meshes of any size, place and condition.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "mesh/import.h"
#include "outline/curvature.h"
#include "pipeline/frame/error.h"
#include "tests/mesh/shapes.h"
#include "tests/outline/allocation_count.h"
#include "tests/outline/surfaces.h"
#include "tests/support/test_data.h"

namespace rinkaku::test {
namespace {

using mesh::Topology;
using outline::Curvature;
using outline::CurvatureMethod;
using outline::CurvatureSolver;

constexpr CurvatureMethod methods[] = {CurvatureMethod::Meyer, CurvatureMethod::Icnc, CurvatureMethod::Quadric,
                                       CurvatureMethod::Auto};

bool all_finite(const Curvature& c) {
  for (const auto* values : {&c.mean, &c.gauss, &c.largest, &c.smallest, &c.area}) {
    for (float v : *values) {
      if (!std::isfinite(v)) return false;
    }
  }
  return std::isfinite(outline::k95(c));
}

// The points and triangles as they are: no import stage cleans them.
Topology raw(std::vector<glm::vec3> points, std::vector<glm::uvec3> faces) {
  mesh::Mesh mesh;
  mesh.positions = std::move(points);
  mesh.triangles = std::move(faces);
  mesh.point_count = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t p = 0; p < mesh.point_count; ++p) mesh.welded.push_back(p);
  return mesh::topology(mesh);
}

std::vector<glm::vec3> scaled(std::vector<glm::vec3> points, float by) {
  for (glm::vec3& p : points) p *= by;
  return points;
}

TEST(CurvatureRobustness, FollowsScale) {
  const Topology topology = mesh::topology(Torus().mesh(48, 24));
  for (CurvatureMethod method : methods) {
    CurvatureSolver solver(topology, method);
    const Curvature one = solver.solve(topology.points);
    for (float by : {1e-6f, 1e-3f, 0.1f, 1e3f, 1e6f}) {
      const Curvature other = solver.solve(scaled(topology.points, by));
      for (std::size_t p = 0; p < one.mean.size(); ++p) {
        // Scaled positions are rounded: 6e-8 of them over edges of 0.05 for normals, over these again for curvature.
        ASSERT_NEAR(other.mean[p] * by, one.mean[p], 1e-3) << by;
        ASSERT_NEAR(other.gauss[p] * by * by, one.gauss[p], 2e-3) << by;
        ASSERT_NEAR(other.area[p] / by / by, one.area[p], 1e-5) << by;
      }
    }
    // Powers of two are exact all the way.
    const Curvature half = solver.solve(scaled(topology.points, 0.5f));
    for (std::size_t p = 0; p < one.mean.size(); ++p) ASSERT_EQ(half.mean[p], 2 * one.mean[p]);
  }
}

TEST(CurvatureRobustness, FiniteAtExtremeSizesAndPlaces) {
  const Topology topology = mesh::topology(Torus().mesh(48, 24));
  for (CurvatureMethod method : methods) {
    CurvatureSolver solver(topology, method);
    for (float by : {0.0f, 1e-44f, 1e-38f, 1e-30f, 1e-20f, 1e-12f, 1e12f, 1e20f, 1e37f}) {
      EXPECT_TRUE(all_finite(solver.solve(scaled(topology.points, by)))) << by;
    }
    for (float away : {1e3f, 1e5f, 1e7f, 1e12f}) {
      std::vector<glm::vec3> moved = topology.points;
      for (glm::vec3& p : moved) p += glm::vec3(away, -away, away / 2);
      EXPECT_TRUE(all_finite(solver.solve(moved))) << away;
    }
  }
}

// As near to the origin as float resolves the shape, place makes no difference.
TEST(CurvatureRobustness, PlaceMakesNoDifference) {
  const Topology topology = mesh::topology(Torus().mesh(48, 24));
  std::vector<glm::vec3> moved = topology.points;
  for (glm::vec3& p : moved) p += glm::vec3(16, -16, 8);
  for (CurvatureMethod method : methods) {
    CurvatureSolver solver(topology, method);
    const Curvature here = solver.solve(topology.points), there = solver.solve(moved);
    for (std::size_t p = 0; p < here.mean.size(); ++p) {
      // Positions are now rounded to 1e-6: over edges of 0.05 that is 2e-5 of a normal, 1e-3 of curvature a face.
      ASSERT_NEAR(there.mean[p], here.mean[p], 0.01);
    }
  }
}

TEST(CurvatureRobustness, FlatIsZeroUpToTheBorder) {
  const Topology topology = grid_surface({8, 5}, [](double u, double v) { return glm::dvec3(u * u, v + 0.3 * u, 0); });
  for (CurvatureMethod method : methods) {
    const Curvature found = outline::curvature(topology, method);
    for (float mean : found.mean) EXPECT_NEAR(mean, 0, 1e-5);  // float, over a size of 1
    EXPECT_NEAR(outline::k95(found), 0, 1e-5);
  }
}

// A needle, a triangle in one line, one in one point, and points in no triangle at all, among sound ones.
TEST(CurvatureRobustness, TrianglesWithoutAreaAndLonePoints) {
  std::vector<glm::vec3> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.3f}, {0.5f, 0, 0},  {0.5f, 1e-20f, 0},
                                   {9, 9, 9}, {9, 9, 9}, {9, 9, 9}, {4, 4, 4},    {1e30f, 0, 0}, {0, -1, 0.2f}};
  const Topology topology =
      raw(points, {{0, 2, 3}, {0, 4, 2}, {4, 1, 2}, {0, 5, 4}, {4, 5, 1}, {6, 7, 8}, {0, 11, 5}, {11, 1, 5}});
  for (CurvatureMethod method : methods) {
    const Curvature found = outline::curvature(topology, method);
    EXPECT_TRUE(all_finite(found));
    for (std::size_t lone : {6u, 7u, 8u, 9u, 10u}) {
      EXPECT_EQ(found.mean[lone], 0);
      EXPECT_EQ(found.gauss[lone], 0);
      EXPECT_EQ(found.area[lone], 0);
    }
    // A lone point 1e30 away takes nothing from the rest.
    EXPECT_GT(std::abs(found.mean[0]), 0.01f);
  }
}

TEST(CurvatureRobustness, PointsOfThreeToAThousandFaces) {
  for (int valence : {3, 4, 100, 1000}) {
    const Topology topology = mesh::topology(double_cone(valence));
    for (CurvatureMethod method : methods) {
      const Curvature found = outline::curvature(topology, method);
      ASSERT_TRUE(all_finite(found)) << valence;
      for (std::size_t p = 0; p < topology.points.size(); ++p) {
        if (std::abs(topology.points[p].z) < 0.5f) continue;
        EXPECT_GT(found.mean[p], 0) << valence;  // both tips are convex
      }
    }
  }
}

// Random points joined at random: folded, intersecting, of many faces an edge.
TEST(CurvatureRobustness, RandomSoup) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-1, 1);
  std::vector<glm::vec3> points(60);
  for (glm::vec3& p : points) p = {place(random), place(random), place(random) * 1e-4f};
  std::vector<glm::uvec3> faces;
  while (faces.size() < 500) {
    const glm::uvec3 f(random() % 60, random() % 60, random() % 60);
    if (f.x != f.y && f.y != f.z && f.z != f.x) faces.push_back(f);
  }
  for (CurvatureMethod method : methods) {
    EXPECT_TRUE(all_finite(outline::curvature(raw(points, faces), method)));
  }
}

TEST(CurvatureRobustness, WindingIsMadeAlikeFirst) {
  mesh::Soup soup = sphere(3);
  for (std::size_t t = 0; t < soup.triangles.size(); t += 3) std::swap(soup.triangles[t].y, soup.triangles[t].z);
  const Topology shuffled = mesh::topology(mesh::assemble(std::move(soup), 180).mesh);
  const Curvature found = outline::curvature(shuffled);
  for (float mean : found.mean) ASSERT_NEAR(mean, 1, 1e-3);  // an edge of 0.1: 6e-8 / 0.1^2, and some more
}

TEST(CurvatureRobustness, SolvingAgainAllocatesNothing) {
  const Topology topology = mesh::topology(Torus().mesh(24, 12));
  for (CurvatureMethod method : methods) {
    CurvatureSolver solver(topology, method);
    const long before = allocations();
    solver.solve(topology.points);
    EXPECT_EQ(allocations(), before);
  }
}

class RealMeshes : public testing::TestWithParam<const char*> {};

TEST_P(RealMeshes, AreFinite) {
  RINKAKU_NEEDS_DATA();
  int meshes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data("meshes") / GetParam())) {
    static const std::vector<std::string> endings = {".obj", ".off", ".ply", ".stl", ".glb", ".gltf", ".vrm"};
    if (std::find(endings.begin(), endings.end(), entry.path().extension().string()) == endings.end()) continue;
    Topology topology;
    try {
      topology = mesh::topology(mesh::import(entry.path()).mesh);
    } catch (const Error& error) {
      // Two VRM files hold a skeleton and no mesh.
      EXPECT_NE(std::string(error.what()).find("it has no faces"), std::string::npos) << error.what();
      continue;
    }
    ++meshes;
    for (CurvatureMethod method : methods) {
      const Curvature found = outline::curvature(topology, method);
      EXPECT_TRUE(all_finite(found)) << entry.path();
    }
  }
  EXPECT_GT(meshes, 0);
}

INSTANTIATE_TEST_SUITE_P(Folders, RealMeshes, testing::Values("analytic", "animated", "closed", "dirty", "open", "vrm"),
                         [](const auto& instance) { return std::string(instance.param); });

TEST(K95, SplitsTheAreaNotThePoints) {
  Curvature c;
  // Many sharp points of little area, one flat point of much.
  for (int i = 0; i < 100; ++i) c.mean.push_back(-50), c.area.push_back(0.0004f);
  c.mean.push_back(2), c.area.push_back(0.96f);
  EXPECT_EQ(outline::k95(c), 2);
  c.area.back() = 0.5f;
  EXPECT_EQ(outline::k95(c), 50);  // the size, whichever the sign
}

}  // namespace
}  // namespace rinkaku::test
