#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "mesh/topology.h"
#include "outline/curvature.h"
#include "outline/ring_smoothing.h"
#include "outline/width_options.h"

namespace rinkaku::outline {

/// What a line's width is multiplied by at each point of a surface, so that it follows the surface's curvature K.
///
///     r = min(|K| / (saturation K95), 1) ^ curve,    factor = 1 + exaggeration r   where the line gets thicker,
///                                                    factor = max(least, 1 / (1 + exaggeration r))   where thinner
///
/// With the kind Mean, the sign Magnitude, curve 1 and no smoothing this is equation 4.3 of Matsuo's thesis on
/// curvature-based outlines as printed: (K t / s + u) n below the threshold s, (t + u) n above, in base lines u. The
/// thesis's s is an absolute curvature, which saturates nearly everywhere on small models; here it counts in K95, so
/// the result is the same at any scale. Then `smoothing` times each factor becomes the mean of itself and its
/// neighbours' mean.
///
/// `curvature` and `k95` are of the topology's points (see outline/curvature.h). Where K95 is 0 (flat) all factors
/// are 1. Between `least` and 1 + exaggeration. Cost: some 50 ns a point, and as much for each smoothing; allocates.
std::vector<float> line_width_factors(const mesh::Topology& topology, const Curvature& curvature, double k95,
                                      const WidthOptions& options);

/// The same again and again for a surface that moves: curvature, factors and their smoothing of each pose. K95 stays
/// that of the rest pose, so that widths don't pump. Keeps no reference; allocates nothing after construction.
class CurvatureWidths {
 public:
  CurvatureWidths(const mesh::Topology& rest, const WidthOptions& options);

  /// The factors at all points, which are in the topology's order. The span lives until the next call. Cost: a
  /// CurvatureSolver::solve(), and for 63,684 points about 0.3 ms and 0.5 ms for each smoothing.
  std::span<const float> at(std::span<const glm::vec3> points);

  /// Writes the factors at the wanted points only (where a line runs, in some frame) into `factors`, one a point of the
  /// surface. Only their surroundings are looked at, unless those are most of the surface.
  void at(std::span<const glm::vec3> points, std::span<const std::uint32_t> wanted, std::span<float> factors);

 private:
  WidthOptions options_;
  CurvatureSolver solver_;
  double k95_ = 0;
  RingSmoothing smoothing_;
  std::vector<float> factors_;
};

}  // namespace rinkaku::outline
