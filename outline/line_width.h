#pragma once

#include <vector>

#include "mesh/topology.h"
#include "outline/curvature.h"
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

}  // namespace rinkaku::outline
