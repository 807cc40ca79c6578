#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/topology.h"
#include "outline/surroundings.h"

namespace rinkaku::outline {

/// Averages values at points of a surface over their neighbours, around some of the points or everywhere: each value
/// becomes the mean of itself and its neighbours' mean, as many times as asked for.
///
/// Keeps no reference. Allocates nothing once warm. Cost: about 10 ns a point and time.
class RingSmoothing {
 public:
  RingSmoothing(const mesh::Topology& topology, int times);

  /// The points whose values are needed so that those at the wanted ones come out smoothed: these, their neighbours and
  /// so on. All points where that would be most of the surface. Until the next call.
  std::span<const std::uint32_t> around(std::span<const std::uint32_t> wanted);
  std::span<const std::uint32_t> everywhere();

  /// Smooths values, one a point, of which those that the last call named are given. Right then for what it was asked
  /// for.
  void smooth(std::span<float> values);

 private:
  void step(std::span<const std::uint32_t> of, std::span<float> values);

  Surroundings points_;
  std::vector<float> smoothed_;
};

}  // namespace rinkaku::outline
