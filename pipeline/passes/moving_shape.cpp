#include "pipeline/passes/moving_shape.h"

#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace rinkaku::passes {

OutlinePush::OutlinePush(const glm::dmat4& world_from_object)
    : world_from_normal_(glm::transpose(glm::inverse(glm::dmat3(world_from_object)))) {
  // An outline normal may come to lie along any axis.
  const glm::dmat3 object_from_world(glm::inverse(world_from_object));
  double squares = 0;
  for (int axis = 0; axis < 3; ++axis) squares += glm::dot(object_from_world[axis], object_from_world[axis]);
  length_m_ = 1 / std::sqrt(squares);
  const glm::dmat3 product = glm::transpose(object_from_world) * object_from_world * (3 / squares);
  evenly_scaled_ = true;
  for (int i = 0; i < 9; ++i) {
    constexpr double rounding = 1e-9;
    evenly_scaled_ = evenly_scaled_ && std::abs(product[i / 3][i % 3] - (i % 4 == 0 ? 1 : 0)) < rounding;
  }
  if (evenly_scaled_) length_m_ *= std::sqrt(3.0);
  object_from_world_ = glm::mat3(object_from_world * length_m_);
}

MovingShape::MovingShape(const mesh::Mesh& mesh, const mesh::Topology& topology, mesh::Rig rig,
                         const mesh::Playback& playback, const glm::dmat4& world_from_object)
    : moving_(mesh, topology, std::move(rig), playback),
      welded_(mesh.welded),
      faces_(topology.faces),
      push_(world_from_object),
      settled_(topology.points.size(), 0) {}

bool MovingShape::move_to(double time_s) {
  if (!moving_.move_points_to(time_s)) return false;
  ++moves_made_;
  return true;
}

void MovingShape::settle(std::uint32_t point, std::span<ShapeVertex> vertices) {
  if (settled_[point] == moves_made_) return;
  settled_[point] = moves_made_;
  const glm::vec3 position = points()[point];
  moving_.skin().pose_normals(point, [&](std::uint32_t v, const mesh::Four& normal, const mesh::Four& outline_normal) {
    vertices[v].position = position;
    vertices[v].normal = snorm(mesh::three(normal));
    vertices[v].outline_normal = snorm(mesh::three(push_(outline_normal)));
  });
}

void MovingShape::write(std::span<MovedVertex> out) const {
  moving_.skin().for_each_vertex(
      [&](std::uint32_t v, const glm::vec3& point, const mesh::Four& normal, const mesh::Four& outline_normal) {
        out[v].position = point;
        write_snorm(normal, push_(outline_normal), out[v]);
      });
}

}  // namespace rinkaku::passes
