#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/topology.h"

namespace rinkaku::outline {

/// For each point of a surface those that an edge joins it to, in the order of the edges. Keeps no reference.
class PointNeighbours {
 public:
  explicit PointNeighbours(const mesh::Topology& topology);

  std::span<const std::uint32_t> at(std::size_t point) const {
    return std::span(points_).subspan(first_[point], first_[point + 1] - first_[point]);
  }

 private:
  std::vector<std::uint32_t> first_, points_;  // per point its run, and the end
};

}  // namespace rinkaku::outline
