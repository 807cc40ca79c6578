#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "mesh/topology.h"

namespace rinkaku::outline {

/// How far it is through a body: from a point of its surface along rays to the first wall of the same component that is
/// seen from within, by a bounding volume hierarchy.
///
/// Keeps a reference to the topology. Building costs about 0.3 microseconds a triangle, a ray about one.
class FarWalls {
 public:
  explicit FarWalls(const mesh::Topology& topology);

  static constexpr float kNone = 3e38f;
  /// The way from the point into the unit `direction`, in the mesh's units; kNone if there is no wall. Faces at the
  /// point itself don't count. `component`: the one that counts.
  float distance(std::uint32_t point, const glm::vec3& direction, std::uint32_t component) const;

 private:
  struct Wall {
    glm::vec3 corner{0}, edge1{0}, edge2{0};  // wound so that their cross product points out of the body
    std::uint32_t face = 0;
  };
  // A run of walls. Of an inner node, one child follows it and the other is at `right`.
  struct Node {
    glm::vec3 min{0}, max{0};
    std::uint32_t first = 0, count = 0;
    std::uint32_t right = 0;  // 0: no children
  };
  std::uint32_t build(std::uint32_t first, std::uint32_t count);

  const mesh::Topology& topology_;
  std::vector<Wall> walls_;
  std::vector<Node> nodes_;
};

}  // namespace rinkaku::outline
