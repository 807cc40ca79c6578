#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rinkaku::mesh {

/// The order from the farthest to the nearest, in which what is blended is drawn: strokes of water (Suzuki et al. 2004,
/// 5.2), triangles of fluff.
///
/// Depths are told apart to 1/65535 of their span; those that are alike keep their order in the list, so that two
/// things don't change places from frame to frame. A radix sort in two passes: linear, no allocation once warm.
class DepthOrder {
 public:
  /// So many depths then take no allocation.
  void reserve(std::size_t depths);
  /// Indices into `depths_m`, farthest first; valid until the next call. Depths must be finite.
  std::span<const std::uint32_t> farthest_first(std::span<const float> depths_m);

 private:
  std::vector<std::uint16_t> keys_, other_keys_;
  std::vector<std::uint32_t> order_, other_order_;
};

}  // namespace rinkaku::mesh
