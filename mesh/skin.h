#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "mesh/mesh.h"
#include "mesh/pose.h"
#include "mesh/rig.h"
#include "mesh/topology.h"

namespace rinkaku::mesh {

/// Bends a mesh: linear blend skinning of any number of influences a point, after blend shapes.
///
/// Normals (for shading, and the points' outline normals) go with the blended matrix's cofactors, so that they stay at
/// right angles under uneven scales, and are never NaN: where a point's surroundings are squeezed to nothing (a scale
/// of 0, a twist by 180 degrees), they keep the direction that the matrix gives them, or the one at rest. What a blend
/// shape does to normals is measured on the mesh: the change of the mean of the faces' normals there.
/// Posed as at rest it gives the mesh back, up to rounding.
///
/// Preconditions: `rig` is of `mesh`, and sound (see rig_message.h). Keeps no reference. Any thread, one at a time.
/// Allocates nothing after construction. Cost of pose(): docs/animation.md.
class Skin {
 public:
  Skin(const Mesh& mesh, const Topology& topology, const Rig& rig);

  void pose(const Pose& pose);

  std::span<const glm::vec3> points() const { return points_; }                    ///< per point
  std::span<const glm::vec3> normals() const { return normals_; }                  ///< per vertex, unit
  std::span<const glm::vec3> outline_normals() const { return outline_normals_; }  ///< per point, unit

  // What pose() starts from, for one that runs on the GPU.
  std::span<const std::uint32_t> first_influence() const { return first_influence_; }
  std::span<const Influence> influences() const { return influences_; }
  std::span<const glm::vec3> bind_points() const { return morphed_points_; }    ///< with the last pose's morphs
  std::span<const glm::vec3> bind_normals() const { return morphed_normals_; }  ///< likewise

 private:
  // A blend shape, with what it does to normals.
  struct Shape {
    std::vector<std::uint32_t> points;
    std::vector<glm::vec3> offsets;
    std::vector<std::uint32_t> bent;  // points whose normal changes
    std::vector<glm::vec3> bends;     // in bind coordinates
  };
  void add_shapes(const Topology& topology, const Rig& rig, std::span<const glm::mat3> bind_from_rest);
  void add_morphs(const Pose& pose);
  void move_point(std::size_t point, const glm::mat4& object_from_bind, const glm::mat3& turn);
  glm::mat4 blended(const Pose& pose, std::size_t point) const;

  std::vector<std::uint32_t> first_influence_;
  std::vector<Influence> influences_;
  std::vector<std::uint32_t> first_vertex_, vertices_;  // of each point
  std::vector<glm::vec3> bind_points_, bind_normals_, bind_outline_normals_;
  std::vector<Shape> shapes_;
  std::vector<glm::vec3> morphed_points_, morphed_normals_, morphed_outline_normals_;
  bool morphed_ = false;
  std::vector<glm::mat3> turns_;  // per joint, of the pose: its cofactors
  std::vector<glm::vec3> points_, normals_, outline_normals_;
};

/// The matrix that normals go with under a linear map: its cofactors, which unlike the inverse's transpose always
/// exist.
glm::mat3 cofactors(const glm::mat3& m);

}  // namespace rinkaku::mesh
