#pragma once

#include <cstdint>
#include <vector>

#include "silhouette/surface.h"
#include "silhouette/view_regions.h"

namespace rinkaku::silhouette {

/// How a triangle stands to a whole view region.
enum class Side : std::uint8_t {
  Silhouette,  ///< neither for certain: an eye of the region may lie in its plane
  Front,       ///< faces every eye of the region
  Back,        ///< turns its back on every eye of the region
};

/// Planes of a surface's triangles in the unit frame, ready to be classified for many regions.
struct TrianglePlanes {
  std::vector<double> x, y, z, d;  ///< x X + y Y + z Z + d: height in front, times least altitude over longest edge
  std::vector<glm::dvec3> corner;  ///< per triangle, a point of it
};
TrianglePlanes triangle_planes(const Surface& surface);

/// Classifies all triangles for a region, from its hull's vertices alone: a half-space that holds them holds the hull.
///
/// Front and back need a margin: as each hull vertex sees it, the triangle is no flatter than `kFlattest`. What is
/// doubtful is silhouette mesh.
/// Cost: about 2 ns a triangle and hull vertex. Allocates nothing if `out` has the capacity.
/// Utsugi et al., "A polygon reduction maintaining silhouettes" (2002), 2.2 and 2.3, equations 1 to 3.
void classify(const TrianglePlanes& planes, const ViewRegion& region, std::vector<Side>& out);

/// How flat a front triangle may look: its least altitude over its longest edge, times the sine of the angle at which
/// the ray to the eye rises over its plane. Rasterisers snap vertices to a grid, and turn flatter ones over.
inline constexpr double kFlattest = 0.004;

}  // namespace rinkaku::silhouette
