#pragma once

#include <array>
#include <vector>

#include <glm/vec3.hpp>

#include "silhouette/view_regions.h"

namespace rinkaku::silhouette {

/// Everywhere that rays from a region's eyes through a triangle come: between the two and beyond, inside the unit
/// sphere. The union of two convex sets, conv(E u T) and T + cone(T - E).
class ShadowBeam {
 public:
  void set_region(const ViewRegion& region);
  void set_triangle(const std::array<glm::dvec3, 3>& triangle);

  /// Whether a segment inside the unit sphere keeps clear of the beam by `kClear`. Errs to no.
  bool is_clear_of(const glm::dvec3& p, const glm::dvec3& q) const;

  /// In radii: what rasterising may move an edge by, with room to spare.
  static constexpr double kClear = 1e-3;

 private:
  /// A convex set: the hull of points, each with all of the directions times 0 to kFar added.
  struct Convex {
    std::vector<glm::dvec3> points;
    std::vector<glm::dvec3> directions;
    /// The set's point that is least along `axis`.
    glm::dvec3 least(const glm::dvec3& axis) const;
  };
  static constexpr double kFar = 8;  // out of the unit sphere, whatever the direction
  static bool apart(const Convex& set, const glm::dvec3& p, const glm::dvec3& q);

  std::vector<glm::dvec3> eyes_;      // finite hull vertices
  std::vector<glm::dvec3> far_eyes_;  // directions of those in infinity
  Convex before_;                     // conv(E u T)
  Convex behind_;                     // T + cone(T - E)
};

}  // namespace rinkaku::silhouette
