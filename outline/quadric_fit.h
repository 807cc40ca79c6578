#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

#include "outline/corrected_curvature.h"
#include "outline/face_stars.h"

namespace rinkaku::outline {

/// Curvatures of the quadric that osculates the surface at each point, fitted to the two rings of points around it.
///
/// After Cazals and Pouget, "Estimating differential quantities using polynomial fitting of osculating jets" (2005): a
/// height field over the tangent plane, through the point, by least squares weighted by 1 / distance^2. Cubic terms are
/// fitted along, so that they don't pass for curvature; where they can't be told from the points, the quadric alone is
/// fitted, and where that can't be either (too few points, or all near one line), what was there stays. The best of the
/// methods on smooth surfaces, however irregular their triangles, short of slivers; across creases it swings.
///
/// The rings are kept, so run() allocates nothing. At most 64 points of the first ring are taken, evenly, and the
/// second ring is not reached through points of more than 32 neighbours: so the cost stays linear at any valence.
class QuadricFit {
 public:
  explicit QuadricFit(const FaceStars& stars);

  /// `points` and `normals`: as CorrectedCurvature's. `values`: kept where no quadric can be fitted. About a
  /// microsecond a point.
  void run(std::span<const glm::vec4> points, std::span<const glm::vec4> normals, std::span<MeanAndGauss> values) const;

 private:
  std::vector<std::uint32_t> first_;  // per point where its run in rings_ starts, and the end
  std::vector<std::uint32_t> rings_;
};

}  // namespace rinkaku::outline
