#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "mesh/mesh.h"
#include "mesh/moving_mesh.h"
#include "mesh/topology.h"
#include "pipeline/passes/moved_vertex.h"
#include "pipeline/passes/shape_vertex.h"

namespace rinkaku::passes {

/// What there is of an object's shape only if it moves: its points of each moment, from which the contour is found, and
/// of its vertices those that somebody on the CPU looks at, which are few. All of them are made where they are drawn
/// from (see MovedVertices). No GL.
class MovingShape {
 public:
  /// Keeps neither mesh nor topology.
  MovingShape(const mesh::Mesh& mesh, const mesh::Topology& topology, mesh::Rig rig, const mesh::Playback& playback,
              const glm::dmat4& world_from_object);

  /// Returns whether it has moved. Allocates nothing.
  bool move_to(double time_s);
  /// How often it has moved so far.
  std::uint64_t moves_made() const { return moves_made_; }

  const mesh::Skin& skin() const { return moving_.skin(); }  ///< with the outline normals of settled points alone
  std::span<const glm::vec3> points() const { return moving_.skin().points(); }
  std::span<const std::uint32_t> welded() const { return welded_; }
  std::span<const glm::uvec3> faces() const { return faces_; }
  const OutlinePush& push() const { return push_; }

  /// Brings the position of a vertex to where it is now.
  void place(std::uint32_t vertex, std::span<ShapeVertex> vertices) const {
    vertices[vertex].position = points()[welded_[vertex]];
  }
  /// Brings everything at a point to where it is now: its vertices, and its normals in skin(). About 50 ns, once a
  /// move.
  void settle(std::uint32_t point, std::span<ShapeVertex> vertices);

  /// All vertices as they are now. Cost: docs/animation.md.
  void write(std::span<MovedVertex> out) const;

 private:
  mesh::MovingMesh moving_;
  std::vector<std::uint32_t> welded_;
  std::vector<glm::uvec3> faces_;
  OutlinePush push_;
  std::uint64_t moves_made_ = 1;
  std::vector<std::uint64_t> settled_;  // per point: the move it was settled in
};

}  // namespace rinkaku::passes
