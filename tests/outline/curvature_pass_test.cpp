// Curvature on the GPU against the same on the CPU.
#include "outline/pass/curvature_pass.h"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "mesh/import.h"
#include "outline/curvature.h"
#include "tests/mesh/shapes.h"
#include "tests/outline/surfaces.h"
#include "tests/pipeline/passes/gl_test.h"
#include "tests/support/test_data.h"

namespace rinkaku::test {
namespace {

using mesh::Topology;
using outline::Curvature;
using outline::CurvaturePass;
using outline::CurvatureSolver;

class GpuCurvature : public GlTest {};

gl::StaticBuffer sent(const std::vector<glm::vec3>& points) {
  std::vector<glm::vec4> padded;
  for (const glm::vec3& p : points) padded.emplace_back(p, 1);
  return gl::StaticBuffer(std::as_bytes(std::span(padded)));
}

std::vector<glm::vec4> read(const gl::StorageBuffer& buffer, std::size_t count) {
  std::vector<glm::vec4> values(count);
  buffer.read(std::as_writable_bytes(std::span(values)));
  return values;
}

// How much larger the parts are than the sum that is a point's normal: faces that face each other nearly cancel out.
std::vector<double> cancellation_of(const CurvatureSolver& solver, const std::vector<glm::vec3>& points) {
  std::vector<double> parts(points.size(), 0);
  std::vector<glm::dvec3> sum(points.size(), glm::dvec3(0));
  for (const glm::uvec3& face : solver.stars().faces) {
    for (int c = 0; c < 3; ++c) {
      const glm::dvec3 at = points[face[c]];
      const glm::dvec3 a = glm::dvec3(points[face[(c + 1) % 3]]) - at, b = glm::dvec3(points[face[(c + 2) % 3]]) - at;
      const glm::dvec3 part = glm::cross(a, b) / (glm::dot(a, a) * glm::dot(b, b));
      sum[face[c]] += part;
      parts[face[c]] += glm::length(part);
    }
  }
  for (std::size_t p = 0; p < points.size(); ++p) parts[p] /= glm::length(sum[p]);
  return parts;
}

struct Rounding {
  double mean = 0, gauss = 0;
};

// What one rounding of the normals around a point makes of its curvatures. mu1 multiplies normals by edges and mu2
// normals by their differences; half of the one's sum over the area and the other's are the curvatures. A normal is
// rounded as often more as its parts cancel out.
std::vector<Rounding> rounding_of(const CurvatureSolver& solver, const std::vector<glm::vec3>& points,
                                  const std::vector<glm::vec4>& normals) {
  const std::vector<double> cancellation = cancellation_of(solver, points);
  std::vector<Rounding> rounding(points.size());
  const auto around = [](const auto& at, const glm::uvec3& face) {
    const glm::dvec3 a(at[face.x]), b(at[face.y]), c(at[face.z]);
    return glm::length(b - a) + glm::length(c - b) + glm::length(a - c);
  };
  for (std::size_t p = 0; p < points.size(); ++p) {
    double edges = 0, turns = 0, area = 0, worst = 1;
    for (std::uint32_t corner : solver.stars().at(p)) {
      const glm::uvec3& face = solver.stars().faces[corner / 3];
      const glm::dvec3 a = points[face.x], b = points[face.y], c = points[face.z];
      edges += around(points, face);
      turns += around(normals, face);
      area += glm::length(glm::cross(b - a, c - a)) / 2;
      for (int k = 0; k < 3; ++k) worst = std::max(worst, cancellation[face[k]]);
    }
    const double one = std::numeric_limits<float>::epsilon() * worst;
    if (area > 0) rounding[p] = {one * edges / (2 * area), one * turns / area};
  }
  return rounding;
}

// Points of `points`: those of the topology, or moved ones.
void expect_agreement(const Topology& topology, const std::vector<glm::vec3>& points) {
  CurvatureSolver solver(topology);
  CurvaturePass pass(solver.stars(), topology.points);
  const gl::StaticBuffer buffer = sent(points);
  pass.run(buffer.name());
  const Curvature& cpu = solver.solve(points);
  const std::vector<glm::vec4> gpu = read(pass.curvatures(), pass.point_count());
  const std::vector<Rounding> rounding = rounding_of(solver, points, read(pass.normals(), pass.point_count()));
  for (std::size_t p = 0; p < points.size(); ++p) {
    // Both do the same operations in the same order, and differ where the driver fuses some.
    ASSERT_NEAR(gpu[p].x, cpu.mean[p], rounding[p].mean) << "mean at " << p;
    ASSERT_NEAR(gpu[p].y, cpu.gauss[p], rounding[p].gauss) << "gauss at " << p;
    ASSERT_TRUE(std::isfinite(gpu[p].z) && std::isfinite(gpu[p].w));
    ASSERT_GE(gpu[p].z, gpu[p].w);
  }
}

TEST_F(GpuCurvature, AgreesWithTheCpuWithinRounding) {
  const Topology topology = mesh::topology(Torus().mesh(96, 48));
  expect_agreement(topology, topology.points);
}

// The scale stays the rest pose's.
TEST_F(GpuCurvature, FollowsMovedPoints) {
  const Topology topology = mesh::topology(Torus().mesh(96, 48));
  std::vector<glm::vec3> moved = topology.points;
  for (glm::vec3& p : moved) p = glm::vec3(12 * p.x + 3 * p.y * p.y, 5 * p.y - 100, 9 * p.z + p.x * p.x);
  expect_agreement(topology, moved);
}

TEST_F(GpuCurvature, AgreesOnRealMeshes) {
  RINKAKU_NEEDS_DATA();
  for (const char* name : {"closed/oded_armadillo_29k.obj", "closed/pmp_fandisk_13k.off", "open/mlab_laurana_50k.ply",
                           "analytic/torus_slivers_jittered_4k6.obj", "dirty/cgal_boeing_soup.off",
                           "dirty/mlab_office_chair.obj", "dirty/cgal_blobby_shuffled_winding.off"}) {
    SCOPED_TRACE(name);
    const Topology topology = mesh::topology(mesh::import(data(std::string("meshes/") + name)).mesh);
    expect_agreement(topology, topology.points);
  }
}

TEST_F(GpuCurvature, NormalsAreTheSpheresOwn) {
  const Topology topology = mesh::topology(mesh::assemble(sphere(4), 180).mesh);
  CurvaturePass pass(outline::face_stars(topology), topology.points);
  pass.run(sent(topology.points).name());
  const std::vector<glm::vec4> normals = read(pass.normals(), pass.point_count());
  for (std::size_t p = 0; p < normals.size(); ++p) {
    ASSERT_GT(glm::dot(glm::vec3(normals[p]), topology.points[p]), 1 - 1e-6f);  // exact but for rounding
  }
}

TEST_F(GpuCurvature, IsTheSameEachTime) {
  const Topology topology = mesh::topology(Torus().mesh(200, 100));
  CurvaturePass pass(outline::face_stars(topology), topology.points);
  const gl::StaticBuffer buffer = sent(topology.points);
  pass.run(buffer.name());
  const std::vector<glm::vec4> first = read(pass.curvatures(), pass.point_count());
  for (int again = 0; again < 3; ++again) {
    pass.run(buffer.name());
    ASSERT_EQ(read(pass.curvatures(), pass.point_count()), first);
  }
}

TEST_F(GpuCurvature, SizesAndLonePointsStayFinite) {
  const Topology torus = mesh::topology(Torus().mesh(24, 12));
  for (float by : {1e-6f, 1e6f}) {
    Topology sized = torus;
    for (glm::vec3& p : sized.points) p *= by;
    sized.points.emplace_back(1e30f, 0, 0);
    CurvatureSolver solver(sized);
    CurvaturePass pass(solver.stars(), sized.points);
    pass.run(sent(sized.points).name());
    const std::vector<glm::vec4> gpu = read(pass.curvatures(), pass.point_count());
    const Curvature& cpu = solver.solve(sized.points);
    for (std::size_t p = 0; p < torus.points.size(); ++p) ASSERT_NEAR(gpu[p].x * by, cpu.mean[p] * by, 1e-5);
    EXPECT_EQ(gpu.back(), glm::vec4(0));
  }
}

}  // namespace
}  // namespace rinkaku::test
