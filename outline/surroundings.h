#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/topology.h"
#include "outline/point_neighbours.h"

namespace rinkaku::outline {

/// Some points of a surface with their neighbours, those points' neighbours and so on: what values at the points depend
/// on if they are averaged over neighbours a few times.
///
/// Keeps no reference. Allocates nothing once warm. Cost: about 10 ns a point and ring.
class Surroundings {
 public:
  Surroundings(const mesh::Topology& topology, int rings);

  /// Looks around the wanted points. All points count as wanted where rings would be most of the surface.
  void look_around(std::span<const std::uint32_t> wanted);
  void look_everywhere() { whole_ = true; }

  /// The points within so many edges of those wanted, each once; 0: these themselves. Until the next look.
  std::span<const std::uint32_t> within(int edges) const {
    return whole_ ? std::span<const std::uint32_t>(all_)
                  : std::span<const std::uint32_t>(found_).first(ends_[static_cast<std::size_t>(edges)]);
  }
  int rings() const { return rings_; }
  const PointNeighbours& neighbours() const { return neighbours_; }

 private:
  int rings_ = 0;
  PointNeighbours neighbours_;
  std::vector<std::uint32_t> all_;
  std::vector<std::uint32_t> found_, ends_;  // the wanted points, then their neighbours, ...
  bool whole_ = true;
  std::vector<std::uint32_t> seen_at_;  // per point: by which look
  std::uint32_t look_ = 0;
};

}  // namespace rinkaku::outline
