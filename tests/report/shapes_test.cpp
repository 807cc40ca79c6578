#include "report/sections/shapes.h"

#include <cmath>
#include <iterator>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <gtest/gtest.h>

#include "mesh/topology.h"

namespace rinkaku::report {
namespace {

// Curvature of the level set f = 0 from its first and second derivatives, taken by differences: an independent way.
struct Level {
  double mean, gauss;
};
template <typename F>
Level level_curvature(const F& f, const glm::dvec3& p) {
  constexpr double h = 1e-4;
  glm::dvec3 g;
  glm::dmat3 second;
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 a(0);
    a[i] = h;
    g[i] = (f(p + a) - f(p - a)) / (2 * h);
    for (int j = 0; j < 3; ++j) {
      glm::dvec3 b(0);
      b[j] = h;
      second[i][j] = (f(p + a + b) - f(p + a - b) - f(p - a + b) + f(p - a - b)) / (4 * h * h);
    }
  }
  const double size = glm::length(g);
  const double trace = second[0][0] + second[1][1] + second[2][2];
  const double mean = (size * size * trace - glm::dot(g, second * g)) / (2 * size * size * size);
  // The second derivative's adjugate.
  const glm::dmat3& s = second;
  const glm::dvec3 r0(s[1][1] * s[2][2] - s[1][2] * s[2][1], s[1][2] * s[2][0] - s[1][0] * s[2][2],
                      s[1][0] * s[2][1] - s[1][1] * s[2][0]);
  const glm::dvec3 r1(s[0][2] * s[2][1] - s[0][1] * s[2][2], s[0][0] * s[2][2] - s[0][2] * s[2][0],
                      s[0][1] * s[2][0] - s[0][0] * s[2][1]);
  const glm::dvec3 r2(s[0][1] * s[1][2] - s[0][2] * s[1][1], s[0][2] * s[1][0] - s[0][0] * s[1][2],
                      s[0][0] * s[1][1] - s[0][1] * s[1][0]);
  const glm::dvec3 adjugate_g(glm::dot(r0, g), glm::dot(r1, g), glm::dot(r2, g));
  return {mean, glm::dot(g, adjugate_g) / std::pow(size, 4)};
}

constexpr double kDifferences = 2e-4;  // what differences of 1e-4 are off by, with the meshes' floats

TEST(Shapes, CurvatureFormulasAgreeWithDifferencesOfTheImplicitSurface) {
  const Torus torus;
  const auto ring = [&](const glm::dvec3& p) {
    return std::hypot(std::hypot(p.x, p.y) - torus.outer, p.z) - torus.inner;
  };
  for (const glm::vec3& p : mesh::topology(torus.mesh(17, 11)).points) {
    const Level level = level_curvature(ring, glm::dvec3(p));
    EXPECT_NEAR(torus.mean_curvature(p), level.mean, kDifferences);
    EXPECT_NEAR(torus.gauss_curvature(p), level.gauss, kDifferences);
  }
  const Ellipsoid egg;
  const auto quadric = [&](const glm::dvec3& p) { return glm::dot(p / egg.axes, p / egg.axes) - 1; };
  for (const glm::vec3& p : mesh::topology(egg.mesh(7)).points) {
    const Level level = level_curvature(quadric, glm::dvec3(p));
    EXPECT_NEAR(egg.mean_curvature(p), level.mean, kDifferences);
    EXPECT_NEAR(egg.gauss_curvature(p), level.gauss, kDifferences);
  }
}

TEST(Shapes, AreClosedManifoldsOfTheirSizeThatFaceOutwards) {
  const Torus torus;
  const mesh::Mesh meshes[] = {torus.mesh(20, 12), torus.mesh(20, 12, 0.4, 3), Ellipsoid().mesh(6), bumpy_ball(6)};
  const std::size_t triangles[] = {480, 480, 288, 288};
  for (std::size_t i = 0; i < std::size(meshes); ++i) {
    const mesh::Topology topology = mesh::topology(meshes[i]);
    EXPECT_EQ(topology.faces.size(), triangles[i]) << i;
    EXPECT_EQ(topology.consistent_edges, topology.edges.size()) << i;
    double volume = 0;
    for (const glm::uvec3& f : topology.faces) {
      const glm::dvec3 a(topology.points[f.x]), b(topology.points[f.y]), c(topology.points[f.z]);
      volume += glm::dot(a, glm::cross(b, c)) / 6;
    }
    EXPECT_GT(volume, 0) << i;
  }
}

TEST(Shapes, MovedPointsStayOnTheTorusAndFollowTheSeed) {
  const Torus torus;
  const auto points = mesh::topology(torus.mesh(20, 12, 0.4, 3)).points;
  for (const glm::vec3& p : points) {
    EXPECT_NEAR(std::hypot(std::hypot(p.x, p.y) - torus.outer, p.z), torus.inner, 1e-6);  // float
  }
  EXPECT_EQ(points, mesh::topology(torus.mesh(20, 12, 0.4, 3)).points);
  EXPECT_NE(points, mesh::topology(torus.mesh(20, 12, 0.4, 4)).points);
}

}  // namespace
}  // namespace rinkaku::report
