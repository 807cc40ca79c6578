#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "mesh/topology.h"

namespace rinkaku::outline {

/// The faces around each point of a welded surface: what every per-point measure sums over, on the CPU and on the GPU.
/// A value that depends on the connectivity alone, so it stays while points move.
struct FaceStars {
  std::vector<glm::uvec3> faces;  ///< over points, wound alike: Topology's `turned` faces are turned
  /// Per point where its run in `corners` starts, and the end: point_count() + 1 numbers.
  std::vector<std::uint32_t> first{0};
  std::vector<std::uint32_t> corners;  ///< 3 * face + corner, of one point in the order of the faces
  std::vector<std::uint8_t> open;      ///< per point: 1 on a border or at an edge of more than two faces

  std::size_t point_count() const { return open.size(); }
  std::span<const std::uint32_t> at(std::size_t point) const {
    return std::span(corners).subspan(first[point], first[point + 1] - first[point]);
  }
};

/// Cost: about 5 ns a triangle.
FaceStars face_stars(const mesh::Topology& topology);

}  // namespace rinkaku::outline
