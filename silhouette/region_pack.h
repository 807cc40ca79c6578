#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/reduce.h"
#include "silhouette/surface.h"
#include "silhouette/view_regions.h"

namespace rinkaku::silhouette {

/// A region as it is stored; see region_format.fbs.
struct PackedRegion {
  std::vector<std::uint8_t> data;
  std::uint32_t role_bytes = 0;
  std::uint32_t silhouette = 0;
  std::uint32_t hidden = 0;
  std::uint32_t colour = 0;
  std::uint32_t matte_front = 0, matte_front_bytes = 0;
  std::uint32_t depth_front = 0, depth_front_bytes = 0;
};

/// Compresses regions, one after the other, reusing its memory.
class RegionPacker {
 public:
  /// Keeps a reference to the surface.
  explicit RegionPacker(const Surface& surface) : surface_(surface) {}

  PackedRegion pack(const RegionMeshes& meshes);

 private:
  /// Appends a front mesh, in an order that compresses well; returns its bytes.
  std::uint32_t append_front(const std::vector<glm::uvec3>& triangles, std::vector<std::uint8_t>& data);

  const Surface& surface_;
  std::vector<std::uint32_t> indices_;
  std::vector<std::uint32_t> ordered_;
};

/// Puts a file together. Throws Error (Input) if it would be too large for the format (2 GB).
std::vector<std::uint8_t> region_file_bytes(const Surface& surface, const ViewSpace& space, double depth_distance,
                                            std::span<const PackedRegion> regions);

}  // namespace rinkaku::silhouette
