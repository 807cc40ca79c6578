// Vertices that a compute shader makes against those that the CPU makes.
#include "pipeline/passes/moved_vertices.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <initializer_list>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "tests/mesh/rigs.h"
#include "tests/pipeline/passes/gl_test.h"

namespace rinkaku::test {
namespace {

using passes::MovedVertex;
using passes::MovedVertices;
using passes::MovingShape;
using passes::Skinning;

class MovedVerticesOf : public GlTest {};

MovingShape shape_of(const Rigged& rigged, std::uint32_t animation = 0, const glm::dmat4& place = glm::dmat4(1)) {
  return MovingShape(rigged.mesh, mesh::topology(rigged.mesh), rigged.rig, {.animation = animation}, place);
}

std::vector<MovedVertex> made(MovedVertices& vertices, const MovingShape& shape) {
  vertices.follow(shape);
  std::vector<MovedVertex> out(shape.welded().size());
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(vertices.name(), 0, static_cast<GLsizeiptr>(out.size() * sizeof(MovedVertex)), out.data());
  return out;
}

int apart(const std::array<std::int16_t, 4>& a, const std::array<std::int16_t, 4>& b) {
  int most = 0;
  for (std::size_t k = 0; k < 4; ++k) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

void expect_alike(MovingShape shape, std::initializer_list<double> times_s) {
  MovedVertices by_cpu(shape, Skinning::Cpu), by_gpu(shape, Skinning::Gpu);
  ASSERT_FALSE(by_cpu.on_gpu());
  ASSERT_TRUE(by_gpu.on_gpu());
  for (const double time_s : times_s) {
    shape.move_to(time_s);
    const std::vector<MovedVertex> cpu = made(by_cpu, shape), gpu = made(by_gpu, shape);
    for (std::size_t v = 0; v < cpu.size(); ++v) {
      // The same operations in the same order, none contracted.
      ASSERT_EQ(cpu[v].position, gpu[v].position) << v << " at " << time_s;
      ASSERT_EQ(cpu[v].position, shape.points()[shape.welded()[v]]);
      // Square roots and divisions may round another way, which turns at most the last bit of the code.
      ASSERT_LE(apart(cpu[v].normal, gpu[v].normal), 1) << v << " at " << time_s;
      ASSERT_LE(apart(cpu[v].outline_normal, gpu[v].outline_normal), 1) << v << " at " << time_s;
    }
  }
}

TEST_F(MovedVerticesOf, BentAndTwistedMeshesAreThoseOfTheCpu) {
  const Rigged cylinder = bending_cylinder(33, 30);
  expect_alike(shape_of(cylinder), {0.0, 0.3, 0.77});
  expect_alike(shape_of(cylinder, 1), {0.2, 0.6});
}

TEST_F(MovedVerticesOf, UnevenAndMirroredScalesPushAlike) {
  const glm::dmat4 uneven = glm::scale(glm::rotate(glm::dmat4(1), 0.4, glm::dvec3(1, 2, 3)), {-1.5, 0.2, 3});
  expect_alike(shape_of(bending_cylinder(16, 12), 0, uneven), {0.5});
}

TEST_F(MovedVerticesOf, MeshesWithoutExtentKeepDirections) {
  Rigged cylinder = bending_cylinder(16, 12);
  for (const glm::vec3 scale : {glm::vec3(0), glm::vec3(0, 1, 1), glm::vec3(1e12f)}) {
    cylinder.rig.animations[0] = still(0, {0, 0, 0}, glm::quat(1, 0, 0, 0), scale);
    expect_alike(shape_of(cylinder), {0.0});
  }
}

TEST_F(MovedVerticesOf, BlendShapesComeAndGo) {
  mesh::Soup soup = sphere(3);
  mesh::Morph& morph = soup.rig.morphs.emplace_back();
  for (std::uint32_t v = 0; v < soup.positions.size(); ++v) {
    morph.points.push_back(v);
    morph.offsets.emplace_back(0, 0, soup.positions[v].z);
  }
  Rigged ball = on_one_node(std::move(soup));
  mesh::Animation grown = still(0, {0, 0, 0}, glm::quat(1, 0, 0, 0), glm::vec3(1));
  grown.morph_tracks.push_back({0, 1, {0.0f, 0.5f, 1.0f}, {0.0f, 1.0f, 0.0f}});
  ball.rig.animations = {grown};
  expect_alike(shape_of(ball), {0.0, 0.5, 0.25, 0.0});
}

TEST_F(MovedVerticesOf, SettledOnesAreTheSame) {
  const Rigged cylinder = bending_cylinder(16, 12);
  MovingShape shape = shape_of(cylinder);
  std::vector<passes::ShapeVertex> settled(cylinder.mesh.positions.size());
  for (const double time_s : {0.4, 0.8}) {
    shape.move_to(time_s);
    for (std::uint32_t p = 0; p < cylinder.mesh.point_count; ++p) shape.settle(p, settled);
    std::vector<MovedVertex> all(settled.size());
    shape.write(all);
    for (std::size_t v = 0; v < all.size(); ++v) {
      ASSERT_EQ(settled[v].position, all[v].position);
      // The joint's cofactors are found once or for the point: the same numbers.
      ASSERT_EQ(settled[v].normal, all[v].normal);
      ASSERT_EQ(settled[v].outline_normal, all[v].outline_normal);
    }
  }
}

TEST_F(MovedVerticesOf, AreMadeWhereOpenGlIs) {
  const Rigged cylinder = bending_cylinder(8, 4);
  const MovingShape shape = shape_of(cylinder);
  EXPECT_EQ(MovedVertices(shape, Skinning::Auto).on_gpu(), !context().software());
}

}  // namespace
}  // namespace rinkaku::test
