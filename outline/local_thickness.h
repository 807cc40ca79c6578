#pragma once

#include <vector>

#include "mesh/topology.h"

namespace rinkaku::outline {

/// How thick a body is at each point of its surface, in the mesh's units: the median length of seven rays through it,
/// one against the outline normal and six at 20 degrees to it, to the first wall that is seen from within (Shapira,
/// Shamir and Cohen-Or, "Consistent mesh partitioning and skeletonisation using the shape diameter function", 2008,
/// with fewer rays and a narrow cone). Of a plate of thickness t that is t / cos 20°, of a ball of diameter D it is D
/// cos 20°, of a rod between: within 7 % of the thickness. Unlike the largest ball within, it doesn't vanish along
/// sharp edges.
///
/// Each component counts by itself. Where most rays find no wall (the tip of a needle, a border), a point has the mean
/// of its neighbours'; what has no wall at all, as an open sheet, has the diagonal of the mesh's box. Of 10,000
/// points and more about every third is looked at, the others have the mean of those beside them. The result is
/// averaged eight times over neighbours. Finite and at least 0. Cost: about 4 microseconds a point, of fewer points 10;
/// allocates.
std::vector<float> local_thickness(const mesh::Topology& topology);

}  // namespace rinkaku::outline
