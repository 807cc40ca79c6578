#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>

#include "embedded/region_format_generated.h"

namespace rinkaku::silhouette {

/// Sum over bytes that tells damage, not malice.
std::uint64_t check_of(std::span<const std::uint8_t> bytes);

/// What a file says about itself, apart from its version and the regions' bytes.
struct RegionFileHead {
  std::uint64_t mesh_hash = 0;
  std::uint32_t points = 0;
  std::uint32_t mesh_triangles = 0;
  std::uint64_t full_triangles = 0;
  double centre[3] = {};
  double radius = 0;
  std::uint64_t cells = 0;
  std::uint64_t shells = 0;
  double inner_radii = 0;
  double depth_distance = 0;
};

/// The sum over a file's head and its other arrays: hull, triangles, sides, table of regions.
std::uint64_t check_of(const RegionFileHead& head, std::initializer_list<std::span<const std::uint8_t>> arrays);

}  // namespace rinkaku::silhouette
