#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "outline/fluffy/band.h"
#include "silhouette/surface.h"
#include "silhouette/view_regions.h"

namespace rinkaku::fluffy {

/// For each region that the eye may be in, the triangles that any eye of it has in the band, listed beforehand: the
/// view candidates of Yamachi et al., made so that perspective is right and none is ever missed.
///
/// Where a corner's facing is above sin(w / 2) the eye is within a cone about the corner's normal, which is convex. So
/// a region's hull vertices decide for all its eyes whether a corner is clear of the band on the outer side, or
/// likewise on the inner one; a triangle is left out only if all its corners are clear on the same side.
class BandLists {
 public:
  /// Precondition: `layout` is silhouette::check()ed. Cost: 5 to 10 ns a point and region, on all cores.
  BandLists(const BandSurface& surface, double sine, const silhouette::RegionLayout& layout);

  /// The region an eye is in, by the surface's own coordinates; nothing nearer than the inner radius, where BandCut
  /// serves. Constant time.
  std::optional<std::uint32_t> region(const glm::dvec3& eye) const { return finder_.find(frame_.to_unit(eye)); }

  /// Writes a region's triangles, ascending, in place of what `triangles` holds. About 1 ns a triangle; allocates
  /// nothing if it has the capacity for all.
  void list(std::uint32_t region, std::vector<std::uint32_t>& triangles) const;

  std::uint32_t region_count() const { return static_cast<std::uint32_t>(first_byte_.size()) - 1; }
  std::size_t bytes() const { return runs_.size() + first_byte_.size() * sizeof(first_byte_[0]); }
  /// The centre and radius that eyes are told in.
  const silhouette::UnitFrame& unit_frame() const { return frame_; }

 private:
  silhouette::UnitFrame frame_;
  silhouette::RegionFinder finder_;
  // Per region: in turns how many triangles are left out and how many listed, seven bits a byte.
  std::vector<std::uint8_t> runs_;
  std::vector<std::uint32_t> first_byte_;
};

}  // namespace rinkaku::fluffy
