#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace rinkaku::mesh {

/// One side of a face: from its corner to its next corner.
struct HalfEdge {
  std::uint32_t low = 0, high = 0;  ///< the points at its ends, low < high
  std::uint32_t face = 0;
  std::uint8_t corner = 0;  ///< 0, 1 or 2: where it starts
  bool reversed = false;    ///< runs from high to low
};

/// All half-edges of a triangle list over points, those of one edge beside each other, edges by their points' numbers,
/// half-edges by their face. Precondition: no triangle has one point twice.
/// Cost: linear; about 50 ns a triangle.
std::vector<HalfEdge> half_edges_by_edge(std::span<const glm::uvec3> faces, std::uint32_t point_count);

/// The half-edges of the edge that starts at `first` in such a list.
inline std::span<const HalfEdge> edge_at(std::span<const HalfEdge> half_edges, std::size_t first) {
  std::size_t end = first + 1;
  while (end < half_edges.size() && half_edges[end].low == half_edges[first].low &&
         half_edges[end].high == half_edges[first].high) {
    ++end;
  }
  return half_edges.subspan(first, end - first);
}

}  // namespace rinkaku::mesh
