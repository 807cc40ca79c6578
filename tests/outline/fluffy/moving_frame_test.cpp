#include "outline/fluffy/moving_frame.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "mesh/assemble.h"
#include "mesh/topology.h"
#include "outline/fluffy/cutter.h"
#include "outline/fluffy/draw_order.h"
#include "tests/mesh/shapes.h"
#include "tests/outline/allocation_count.h"

namespace rinkaku::test {
namespace {

using fluffy::Frame;
using fluffy::FrameOptions;
using fluffy::Growth;
using fluffy::MovingFrame;

const glm::dmat3 mirrored_and_uneven(-1.3, 0, 0, 0.2, 1, 0, 0, 0, 0.8);

// An egg whose upper half is fluffy.
mesh::Mesh egg() {
  mesh::Soup soup = sphere(4);
  for (glm::vec3& p : soup.positions) p = {0.5f * p.x, p.y + 0.2f * p.x * p.x, 1.4f * p.z};
  const auto upper = std::stable_partition(soup.triangles.begin(), soup.triangles.end(), [&](const glm::uvec3& t) {
    return soup.positions[t.x].y + soup.positions[t.y].y + soup.positions[t.z].y > 0;
  });
  const auto count = static_cast<std::uint32_t>(soup.triangles.size());
  const auto fluffy = static_cast<std::uint32_t>(upper - soup.triangles.begin());
  soup.parts = {{"coat", 0, fluffy, 0}, {"skin", fluffy, count - fluffy, 0}};
  return mesh::assemble(std::move(soup), 60).mesh;
}

glm::vec3 bent(const glm::vec3& p) {
  const float turn = 0.8f * p.z;
  return {std::cos(turn) * p.x - std::sin(turn) * p.y, std::sin(turn) * p.x + std::cos(turn) * p.y + 0.3f * p.x, p.z};
}

FrameOptions coat(Growth growth) {
  FrameOptions options;
  options.selection.names = {"coat"};
  options.growth = growth;
  if (growth == Growth::AlongNormals) options.length_m = 0.1;
  return options;
}

struct Moved {
  explicit Moved(const FrameOptions& options, const glm::dmat3& world_from_object = glm::dmat3(1))
      : mesh(egg()), topology(mesh::topology(mesh)), linear(world_from_object) {
    frame.emplace(fluffy::make_frame(mesh, topology, linear, options, "test"), topology, linear);
  }
  // The points as they are when bent, and the frame of a mesh made so.
  std::vector<glm::vec3> points() const {
    std::vector<glm::vec3> out;
    for (const glm::vec3& p : topology.points) out.push_back(bent(p));
    return out;
  }
  Frame made_so(const FrameOptions& options) const {
    mesh::Mesh other = mesh;
    for (glm::vec3& p : other.positions) p = bent(p);
    return fluffy::make_frame(other, mesh::topology(other), linear, options, "test");
  }

  mesh::Mesh mesh;
  mesh::Topology topology;
  glm::dmat3 linear;
  std::optional<MovingFrame> frame;
};

// Places and growth are floats of about 1 that came from doubles which differ by rounding.
constexpr float rounding = 1e-6f;

void expect_same(const Frame& a, const Frame& b) {
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t p = 0; p < a.points.size(); ++p) {
    EXPECT_LT(glm::length(a.points[p] - b.points[p]), rounding);
    EXPECT_LT(glm::length(a.normals[p] - b.normals[p]), rounding);
    EXPECT_LT(glm::length(a.growth[p] - b.growth[p]), rounding);
  }
  EXPECT_NEAR(a.longest_m, b.longest_m, rounding);
}

TEST(MovingFrame, IsTheFrameOfAMeshMadeSo) {
  for (const Growth growth : {Growth::AlongNormals, Growth::Scaled}) {
    for (const glm::dmat3& linear : {glm::dmat3(1), mirrored_and_uneven}) {
      Moved moved(coat(growth), linear);
      const Frame rest = moved.frame->frame(), made = moved.made_so(coat(growth));
      ASSERT_LT(rest.points.size(), moved.topology.points.size());
      moved.frame->move(moved.points());
      expect_same(moved.frame->frame(), made);
      // It moved so far that this means something.
      float farthest = 0;
      for (std::size_t p = 0; p < made.points.size(); ++p) {
        farthest = std::max(farthest, glm::length(made.normals[p] - rest.normals[p]));
      }
      EXPECT_GT(farthest, 0.5f);
      // And back.
      moved.frame->move(moved.topology.points);
      expect_same(moved.frame->frame(), rest);
    }
  }
}

TEST(MovingFrame, TuftsStandStillOnTheSkin) {
  Moved moved(coat(Growth::AlongNormals));
  const Frame rest = moved.frame->frame();
  moved.frame->move(moved.points());
  for (std::size_t v = 0; v < rest.vertices.size(); ++v) {
    EXPECT_EQ(moved.frame->frame().vertices[v].uv, rest.vertices[v].uv);
  }
  EXPECT_EQ(moved.frame->frame().triangles, rest.triangles);
}

TEST(MovingFrame, CutAndOrderFollowWithoutAllocating) {
  Moved moved(coat(Growth::AlongNormals));
  const std::vector<glm::vec3> points = moved.points();
  fluffy::CutOptions options;
  options.sine = 0.3;
  fluffy::Cutter cutter(moved.frame->frame(), options);
  fluffy::DrawOrder order(moved.frame->frame(), 2);
  const glm::dvec3 eye(4, 1, 2);
  const long before = allocations();
  moved.frame->move(points);
  cutter.move(moved.frame->frame());
  order.move(moved.frame->frame());
  const auto found = cutter.find(eye);
  const auto sorted = order.sorted(found, eye);
  EXPECT_EQ(allocations(), before);
  const fluffy::BandSurface surface = fluffy::by_corners(moved.made_so(coat(Growth::AlongNormals)));
  std::vector<std::uint32_t> needed;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    if (fluffy::in_band(surface, t, options.sine, eye)) needed.push_back(t);
  }
  ASSERT_FALSE(needed.empty());
  EXPECT_TRUE(std::includes(found.begin(), found.end(), needed.begin(), needed.end()));
  EXPECT_LE(found.size(), needed.size() + 2);  // what lies within rounding of the band's end
  // Two layers a triangle, from far to near by where the triangles are now.
  ASSERT_EQ(sorted.size(), found.size() * 6);
  double last = 1e30;
  for (std::size_t i = 0; i < sorted.size(); i += 6) {
    glm::dvec3 middle(0);
    for (std::size_t k = 0; k < 3; ++k) {
      const Frame& frame = moved.frame->frame();
      middle += glm::dvec3(frame.points[frame.vertices[sorted[i + k] / 2].point]) / 3.0;
    }
    const double distance = glm::length(middle - eye);
    EXPECT_LT(distance, last + 1e-3);  // keys have 65,536 steps over 3 m
    last = distance;
  }
}

TEST(MovingFrame, SkinSqueezedToNothingKeepsItsNormals) {
  Moved moved(coat(Growth::AlongNormals));
  const Frame rest = moved.frame->frame();
  moved.frame->move(std::vector<glm::vec3>(moved.topology.points.size(), glm::vec3(1, 2, 3)));
  for (std::size_t p = 0; p < rest.points.size(); ++p) {
    EXPECT_LT(glm::length(moved.frame->frame().normals[p] - rest.normals[p]), rounding);
  }
}

}  // namespace
}  // namespace rinkaku::test
