#include "outline/point_neighbours.h"

#include <numeric>

namespace rinkaku::outline {

PointNeighbours::PointNeighbours(const mesh::Topology& topology)
    : first_(topology.points.size() + 1, 0), points_(topology.edges.size() * 2) {
  for (const mesh::Edge& edge : topology.edges) {
    ++first_[edge.a + 1];
    ++first_[edge.b + 1];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (const mesh::Edge& edge : topology.edges) {
    points_[next[edge.a]++] = edge.b;
    points_[next[edge.b]++] = edge.a;
  }
}

}  // namespace rinkaku::outline
