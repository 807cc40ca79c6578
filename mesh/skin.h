#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "mesh/bounds.h"
#include "mesh/four.h"
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
  /// The points alone; normals stay as they were. They cost as much again, so whoever needs few takes these.
  void pose_points(const Pose& pose);
  /// The last pose's normals of a point. Sets its outline normal, and calls each(vertex, normal, outline normal) for
  /// its vertices, the latter two as Four.
  template <typename Each>
  void pose_normals(std::uint32_t point, const Each& each);

  std::span<const glm::vec3> points() const { return points_; }                    ///< per point
  std::span<const glm::vec3> normals() const { return normals_; }                  ///< per vertex, unit
  std::span<const glm::vec3> outline_normals() const { return outline_normals_; }  ///< per point, unit
  const Box& box() const { return box_; }                                          ///< of the points

  /// Hands out the last pose, normals included: calls each(vertex, point's position, normal, outline normal) for all
  /// vertices, point by point, the last two as Four. Keeps nothing.
  template <typename Each>
  void for_each_vertex(const Each& each) const;

  // What a pose starts from, for one that runs on the GPU.
  std::span<const std::uint32_t> first_influence() const { return first_influence_; }
  std::span<const Influence> influences() const { return influences_; }
  std::span<const glm::vec3> bind_points() const { return morphed_points_; }    ///< with the last pose's morphs
  std::span<const glm::vec3> bind_normals() const { return morphed_normals_; }  ///< likewise
  std::span<const glm::vec3> bind_outline_normals() const { return morphed_outline_normals_; }
  std::span<const glm::mat4> joints() const { return pose_joints_; }  ///< the last pose's
  /// How often the three above have changed so far.
  std::uint64_t morphs_made() const { return morphs_made_; }

 private:
  // Where joints take what is at a point: positions, and, by the cofactors, normals.
  struct Turn {
    Four x{}, y{}, z{};
    Turn() = default;
    explicit Turn(const FourColumns& m) : x(cross(m.y, m.z)), y(cross(m.z, m.x)), z(cross(m.x, m.y)) {}
  };
  // A blend shape, with what it does to normals.
  struct Shape {
    std::vector<std::uint32_t> points;
    std::vector<glm::vec3> offsets;
    std::vector<std::uint32_t> bent;  // points whose normal changes
    std::vector<glm::vec3> bends;     // in bind coordinates
  };
  void add_shapes(const Topology& topology, const Rig& rig, std::span<const glm::mat3> bind_from_rest);
  void add_morphs(const Pose& pose);
  FourColumns blended(std::size_t point) const;
  Four turned(const Turn& turn, const glm::vec3& normal, std::size_t point) const;
  Four turned_at_rest_or_so(const Four& along, const glm::vec3& normal, std::size_t point) const;

  std::vector<std::uint32_t> first_influence_;
  std::vector<Influence> influences_;
  std::vector<std::uint32_t> first_vertex_, vertices_;  // of each point
  std::vector<glm::vec3> bind_points_, bind_normals_, bind_outline_normals_;
  std::vector<Shape> shapes_;
  std::vector<glm::vec3> morphed_points_, morphed_normals_, morphed_outline_normals_;
  bool morphed_ = false;
  std::uint64_t morphs_made_ = 1;
  // Per joint, of the last pose.
  std::vector<glm::mat4> pose_joints_;
  std::vector<FourColumns> joints_;
  std::vector<Turn> turns_;
  std::vector<glm::vec3> points_, normals_, outline_normals_;
  Box box_;
};

inline FourColumns Skin::blended(std::size_t point) const {
  const std::uint32_t first = first_influence_[point], end = first_influence_[point + 1];
  FourColumns sum = joints_[influences_[first].joint];
  if (end - first == 1) return sum;
  sum = sum * influences_[first].weight;
  for (std::uint32_t i = first + 1; i < end; ++i) sum += joints_[influences_[i].joint] * influences_[i].weight;
  return sum;
}

inline Four Skin::turned(const Turn& turn, const glm::vec3& n, std::size_t point) const {
  constexpr float least_squared = 1e-30f, most_squared = 1e30f;
  const Four along = turn.x * n.x + turn.y * n.y + turn.z * n.z;
  const float squared = sum_of_three(along * along);
  if (squared > least_squared && squared < most_squared) [[likely]]
    return along * (1.0f / std::sqrt(squared));
  return turned_at_rest_or_so(along, n, point);
}

template <typename Each>
void Skin::pose_normals(std::uint32_t point, const Each& each) {
  const Turn turn(blended(point));
  const Four outline_normal = turned(turn, morphed_outline_normals_[point], point);
  outline_normals_[point] = three(outline_normal);
  for (std::uint32_t i = first_vertex_[point]; i < first_vertex_[point + 1]; ++i) {
    const std::uint32_t v = vertices_[i];
    each(v, turned(turn, morphed_normals_[v], point), outline_normal);
  }
}

template <typename Each>
void Skin::for_each_vertex(const Each& each) const {
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const std::uint32_t first = first_influence_[p];
    const Turn turn = first_influence_[p + 1] - first == 1 ? turns_[influences_[first].joint] : Turn(blended(p));
    const Four outline_normal = turned(turn, morphed_outline_normals_[p], p);
    for (std::uint32_t i = first_vertex_[p]; i < first_vertex_[p + 1]; ++i) {
      const std::uint32_t v = vertices_[i];
      each(v, points_[p], turned(turn, morphed_normals_[v], p), outline_normal);
    }
  }
}

}  // namespace rinkaku::mesh
