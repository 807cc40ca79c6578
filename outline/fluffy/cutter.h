#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "outline/fluffy/band.h"
#include "outline/fluffy/band_lists.h"
#include "outline/fluffy/nearest_view.h"

namespace rinkaku::fluffy {

/// How the triangles near the contour are found.
enum class CutMethod {
  Regions,  ///< lists made beforehand for regions of eyes (BandLists); inside their inner radius as Exact
  Exact,    ///< anew for each eye (BandCut)
  Nearest,  ///< the paper's: lists made beforehand for directions (NearestView); misses some
  None,     ///< all triangles, as if nothing were cut
};

struct CutOptions {
  CutMethod method = CutMethod::Exact;
  double sine = 0;                                                                 ///< see band_sine()
  silhouette::RegionLayout regions{.cells = 12, .shells = 6, .inner_radii = 1.5};  ///< for Regions
  std::uint32_t candidates = 600;                                                  ///< for Nearest
};

/// Finds each frame's triangles by one of the methods, with what that method needs and no more.
/// Not thread-safe; find() allocates nothing.
class Cutter {
 public:
  Cutter(const Frame& frame, const CutOptions& options);

  /// Triangles of the frame, ascending: all that are in the band, with the methods' surplus. `eye` in the frame's
  /// coordinates. The span lives until the next call.
  std::span<const std::uint32_t> find(const glm::dvec3& eye);

  /// For animated meshes: where the frame's points are now. Only with Exact and None: lists are made of a pose.
  void move(const Frame& frame);

 private:
  CutMethod method_;
  std::optional<BandCut> exact_;
  std::optional<BandLists> lists_;
  std::optional<NearestView> nearest_;
  std::vector<std::uint32_t> triangles_;  // all, or the last region's
  std::optional<std::uint32_t> region_;   // whose list triangles_ is
};

}  // namespace rinkaku::fluffy
