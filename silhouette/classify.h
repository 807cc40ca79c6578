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
///
/// A triangle flatter than 0.01 (least altitude over longest edge) has no plane: rasterisers snap vertices to a grid
/// and may turn it over, so it is in every region's silhouette mesh.
struct TrianglePlanes {
  std::vector<double> x, y, z, d;  ///< unit normal and offset: x X + y Y + z Z + d is the distance in front
  std::vector<glm::dvec3> corner;  ///< per triangle, a point of it
};
TrianglePlanes triangle_planes(const Surface& surface);

/// Classifies all triangles for a region, from its hull's vertices alone: a half-space that holds them holds the hull.
///
/// Front and back need a margin: the ray from the triangle to each hull vertex rises at least `kMargin` (sine of the
/// angle) over the plane. What is doubtful is silhouette mesh.
/// Cost: about 2 ns a triangle and hull vertex. Allocates nothing if `out` has the capacity.
/// Utsugi et al., "A polygon reduction maintaining silhouettes" (2002), 2.2 and 2.3, equations 1 to 3.
void classify(const TrianglePlanes& planes, const ViewRegion& region, std::vector<Side>& out);

inline constexpr double kMargin = 1e-3;
inline constexpr double kLeastAltitude = 0.01;  ///< of a triangle's longest edge

}  // namespace rinkaku::silhouette
