#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "mesh/topology.h"
#include "outline/fluffy/frame.h"
#include "outline/fluffy/skin.h"

namespace rinkaku::fluffy {

/// The frame of a mesh that moves: places, normals and growth follow the mesh; triangles, texture coordinates and how
/// long fluff is stay as they were at rest, so that tufts stand still on the skin.
class MovingFrame {
 public:
  /// `topology` and `world_from_object` as the frame was made from; keeps no reference.
  MovingFrame(Frame frame, const mesh::Topology& topology, const glm::dmat3& world_from_object);

  const Frame& frame() const { return frame_; }

  /// `points`: where all the mesh's welded points are now, in the object's coordinates. The frame is then that of a
  /// mesh made so. A point none of whose faces has area keeps the normal it had. Allocates nothing. About 0.1
  /// microseconds a face of the fluffy part.
  void move(std::span<const glm::vec3> points);

 private:
  std::uint32_t local(std::vector<std::uint32_t>& numbers, std::uint32_t mesh_point);

  Frame frame_;
  glm::dmat3 world_from_object_;
  std::vector<std::uint32_t> mesh_points_;  // what is looked at: the frame's points, then those about them
  std::vector<SkinFace> faces_;             // all that touch the frame's points
  std::vector<glm::uvec3> chosen_;          // those whose centre growth is from, if it is
  std::vector<glm::dvec3> points_, normals_;
};

}  // namespace rinkaku::fluffy
