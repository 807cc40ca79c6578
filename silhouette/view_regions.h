#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace rinkaku::silhouette {

/// The space around an object cut into regions: the cells of a cube-sphere (each cube face into cells x cells, equal in
/// angle) times shells, uniform in one over the distance, the outermost to infinity. There are none inside the inner
/// radius, where the whole mesh is drawn.
struct RegionLayout {
  int cells = 8;             ///< along an edge of a cube face; 1 to 64
  int shells = 1;            ///< 1 to 16
  double inner_radii = 1.5;  ///< inner radius in radii of the bounding sphere; 1.05 to 100
  bool operator==(const RegionLayout&) const = default;
};

/// A convex set of eyes: the hull of its vertices, in the unit frame (see UnitFrame), homogeneous. w is 1, or 0 for a
/// vertex in infinity that way.
struct ViewRegion {
  std::vector<glm::dvec4> hull;
};

/// Where eyes may be: a layout's regions, or one explicit region, for a camera that stays in one place.
using ViewSpace = std::variant<RegionLayout, ViewRegion>;

/// Throws Error (Input) naming `where` if a layout is out of its limits, or an explicit region has fewer than 4 or more
/// than 64 vertices, has no volume, holds values that are not finite, or touches the unit sphere.
void check(const ViewSpace& space, const char* where);

/// 6 * cells^2 * shells, or 1.
std::uint32_t region_count(const ViewSpace& space);

/// A region's hull. It holds every eye that find_region() gives this index (outer corners are pushed out, as a shell
/// bulges beyond the hull of its corners), and is convex.
/// Precondition: index < region_count().
ViewRegion view_region(const ViewSpace& space, std::uint32_t index);

/// Finds the region an eye is in.
class RegionFinder {
 public:
  /// Precondition: check()ed. Cost: an explicit region of n vertices takes n^4 steps, once.
  explicit RegionFinder(ViewSpace space);

  /// The region with this eye in it, in the unit frame; nothing if no region holds it: inside the inner radius, or
  /// outside an explicit region. Constant time: about 50 ns.
  std::optional<std::uint32_t> find(const glm::dvec3& eye) const;

 private:
  ViewSpace space_;
  std::vector<glm::dvec4> planes_;  ///< of an explicit region: inside is where all are positive or zero
};

}  // namespace rinkaku::silhouette
