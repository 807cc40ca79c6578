#include "silhouette/region_check.h"

#include <type_traits>

#include <xxhash.h>

namespace rinkaku::silhouette {

std::uint64_t check_of(std::span<const std::uint8_t> bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

std::uint64_t check_of(const RegionFileHead& head, std::initializer_list<std::span<const std::uint8_t>> arrays) {
  static_assert(std::is_trivially_copyable_v<RegionFileHead>);
  static_assert(sizeof(RegionFileHead) == 11 * 8, "no padding: its bytes are summed");
  std::uint64_t sum = XXH3_64bits(&head, sizeof head);
  for (const auto& bytes : arrays) sum = XXH3_64bits_withSeed(bytes.data(), bytes.size(), sum + bytes.size());
  return sum;
}

}  // namespace rinkaku::silhouette
