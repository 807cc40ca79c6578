#pragma once

#include <cstdint>
#include <vector>

#include "mesh/topology.h"

namespace rinkaku::mesh {

struct TrianglePair {
  std::uint32_t face0 = 0;
  std::uint32_t face1 = 0;
};

/// The pairs of faces of different components whose bounding boxes meet, each pair once, in no particular order.
///
/// A bounding volume hierarchy is run against itself; what belongs to one component only is not looked into. Cost:
/// about 0.3 microseconds a triangle, and 10 ns a pair of boxes that is looked at; nothing for a single component.
std::vector<TrianglePair> close_pairs(const Topology& topology);

}  // namespace rinkaku::mesh
