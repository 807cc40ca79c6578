#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace rinkaku::silhouette {

/// Clusters of triangles that are left out together where a cone around their normals says that all of them face away
/// from the eye: exact for any eye, and what region meshes are compared with.
///
/// Clusters are meshoptimizer's meshlets of at most 64 vertices and 124 triangles, grown by how alike their normals
/// are. Shirman and Abi-Ezzi, "The cone of normals technique for fast processing of curved patches", 1993.
class ClusterCones {
 public:
  /// `points` and `indices` (three points a triangle) are read only here. About 1 microsecond a triangle.
  ClusterCones(std::span<const glm::vec3> points, std::span<const std::uint32_t> indices);

  /// The triangles left for an eye in the object's coordinates. Valid until the next call.
  std::span<const std::uint32_t> facing(const glm::dvec3& eye);

 private:
  struct Cluster {
    std::uint32_t first_index = 0, index_count = 0;
    glm::dvec3 apex{0}, axis{0};
    double cutoff = 1;  // 1: no cone holds the normals
  };
  std::vector<std::uint32_t> indices_;  // by cluster
  std::vector<Cluster> clusters_;
  std::vector<std::uint32_t> facing_;
};

}  // namespace rinkaku::silhouette
