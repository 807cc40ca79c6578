#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/reduce.h"
#include "silhouette/surface.h"
#include "silhouette/view_regions.h"

namespace rinkaku::silhouette {

/// A region's lists as they are stored.
struct PackedRegion {
  enum List { kSilhouette, kSilhouetteTwoSided, kHidden, kHiddenTwoSided, kMatteFront, kDepthFront, kColour, kLists };
  std::uint32_t triangles[kLists] = {};
  std::uint32_t bytes[kLists] = {};
  std::vector<std::uint8_t> data;
};

/// Compresses regions, one after the other, reusing its memory. Each list is put into an order that compresses well.
class RegionPacker {
 public:
  /// `points`: how many the surface has.
  explicit RegionPacker(std::size_t points) : points_(points) {}

  PackedRegion pack(const RegionMeshes& meshes);

 private:
  void add_list(PackedRegion& out, PackedRegion::List list);
  /// Takes apart what is in one winding and what is in both.
  void split_windings(std::span<const glm::uvec3> triangles);

  std::size_t points_;
  std::vector<std::uint32_t> indices_;
  std::vector<std::uint32_t> ordered_;
  std::vector<std::uint32_t> single_;
  std::vector<std::uint32_t> both_;
};

/// Puts a file together. Throws Error (Input) if it would be too large for the format (2 GB).
std::vector<std::uint8_t> region_file_bytes(const Surface& surface, const ViewSpace& space, double depth_distance,
                                            std::span<const PackedRegion> regions);

}  // namespace rinkaku::silhouette
