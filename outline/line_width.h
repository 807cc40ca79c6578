#pragma once

#include <vector>

#include "mesh/topology.h"
#include "outline/curvature.h"

namespace rinkaku::outline {

/// Which curvature a line's width follows. All count in 1 / length: of Gauss, the square root is taken, with its sign.
enum class CurvatureKind { Mean, Gauss, Largest, Smallest };

/// What hollow and hump do to a line.
enum class CurvatureSign {
  Magnitude,  ///< both make it thicker
  Convex,     ///< humps make it thicker, hollows thinner than the base line
  Concave,    ///< the other way
};

struct WidthOptions {
  CurvatureKind kind = CurvatureKind::Mean;
  CurvatureSign sign = CurvatureSign::Magnitude;
  float exaggeration = 2;  ///< the most that is added to the base line, in base lines: t / u
  float saturation = 1;    ///< the curvature from which on that much is added, in K95: s / K95; above 0
  float curve = 1;         ///< exponent on the way there, above 0: below 1 gentle bends count more, above 1 less
  float least = 0.25f;     ///< the thinnest line, in base lines; above 0, to 1
  int smoothing = 3;       ///< how often factors are averaged over neighbours, so that widths don't jitter
};

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

}  // namespace rinkaku::outline
