#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "silhouette/view_regions.h"

namespace rinkaku::silhouette {

/// What bounds a region's hull, as indices of its vertices.
struct HullFaces {
  std::vector<std::vector<std::uint32_t>> faces;    ///< vertices in one supporting plane, at least three
  std::vector<std::array<std::uint32_t, 2>> edges;  ///< vertices that two faces share
};

/// Finds them by trying the plane through every three vertices; vertices in infinity count as any other. A vertex lies
/// in a plane if it is nearer than 1e-9 of the largest distance of any. Cost: n^4 for n vertices; 10 microseconds
/// for 8.
HullFaces hull_faces(const ViewRegion& region);

}  // namespace rinkaku::silhouette
