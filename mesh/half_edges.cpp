#include "mesh/half_edges.h"

#include <algorithm>

namespace rinkaku::mesh {

std::vector<HalfEdge> half_edges_by_edge(std::span<const glm::uvec3> faces, std::uint32_t point_count) {
  // A counting sort by the lower point, then each point's few half-edges by the higher.
  std::vector<std::uint32_t> first(std::size_t{point_count} + 1, 0);
  for (const glm::uvec3& f : faces) {
    for (int c = 0; c < 3; ++c) ++first[std::min(f[c], f[(c + 1) % 3]) + 1];
  }
  for (std::size_t p = 0; p < point_count; ++p) first[p + 1] += first[p];

  std::vector<HalfEdge> sorted(faces.size() * 3);
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (std::size_t face = 0; face < faces.size(); ++face) {
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t from = faces[face][c];
      const std::uint32_t to = faces[face][(c + 1) % 3];
      sorted[next[std::min(from, to)]++] = {std::min(from, to), std::max(from, to), static_cast<std::uint32_t>(face),
                                            static_cast<std::uint8_t>(c), from > to};
    }
  }
  for (std::size_t p = 0; p < point_count; ++p) {
    std::sort(sorted.begin() + first[p], sorted.begin() + first[p + 1], [](const HalfEdge& l, const HalfEdge& r) {
      return l.high != r.high ? l.high < r.high : l.face < r.face;
    });
  }
  return sorted;
}

}  // namespace rinkaku::mesh
