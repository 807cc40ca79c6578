#include "mesh/depth_order.h"

#include <algorithm>
#include <array>

namespace rinkaku::mesh {

void DepthOrder::reserve(std::size_t depths) {
  keys_.reserve(depths), other_keys_.reserve(depths), order_.reserve(depths), other_order_.reserve(depths);
}

std::span<const std::uint32_t> DepthOrder::farthest_first(std::span<const float> depths_m) {
  const std::size_t n = depths_m.size();
  keys_.resize(n), other_keys_.resize(n), order_.resize(n), other_order_.resize(n);
  if (n == 0) return {};
  const auto [least, most] = std::minmax_element(depths_m.begin(), depths_m.end());
  const float farthest = *most, scale = *most > *least ? 65535.0f / (*most - *least) : 0.0f;
  std::array<std::array<std::uint32_t, 256>, 2> at{};
  for (std::size_t i = 0; i < n; ++i) {
    const auto key = static_cast<std::uint16_t>(std::min((farthest - depths_m[i]) * scale, 65535.0f));
    keys_[i] = key;
    ++at[0][key & 255];
    ++at[1][key >> 8];
  }
  for (auto& digit : at) {
    std::uint32_t sum = 0;
    for (std::uint32_t& count : digit) {
      const std::uint32_t here = count;
      count = sum;
      sum += here;
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t to = at[0][keys_[i] & 255]++;
    other_keys_[to] = keys_[i];
    other_order_[to] = static_cast<std::uint32_t>(i);
  }
  for (std::size_t i = 0; i < n; ++i) order_[at[1][other_keys_[i] >> 8]++] = other_order_[i];
  return order_;
}

}  // namespace rinkaku::mesh
