#include "silhouette/region_check.h"

#include <type_traits>

#include <xxhash.h>

namespace rinkaku::silhouette {

std::uint64_t check_of(std::span<const std::uint8_t> bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

std::uint64_t check_of(const RegionFileHead& head, std::span<const std::uint8_t> hull,
                       std::span<const std::uint8_t> regions) {
  static_assert(std::is_trivially_copyable_v<RegionFileHead>);
  static_assert(sizeof(RegionFileHead) == 11 * 8, "no padding: its bytes are summed");
  const std::uint64_t first = XXH3_64bits(&head, sizeof head);
  return XXH3_64bits_withSeed(regions.data(), regions.size(), XXH3_64bits_withSeed(hull.data(), hull.size(), first));
}

}  // namespace rinkaku::silhouette
