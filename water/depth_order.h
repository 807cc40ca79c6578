#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace rinkaku::water {

/// The order from the farthest to the nearest: strokes are painted over each other in it. (Suzuki et al. 2004, 5.2.)
///
/// Depths are told apart to 1/65535 of their span; those that are alike keep their order in the list, so that two
/// strokes don't change places from frame to frame. A radix sort in two passes: linear, no allocation once warm.
class DepthOrder {
 public:
  /// Indices into `depths_m`, farthest first; valid until the next call. Depths must be finite.
  std::span<const std::uint32_t> farthest_first(std::span<const float> depths_m);

 private:
  std::vector<std::uint16_t> keys_, other_keys_;
  std::vector<std::uint32_t> order_, other_order_;
};

}  // namespace rinkaku::water
