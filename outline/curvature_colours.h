#pragma once

#include <glm/vec4.hpp>

#include "mesh/mesh.h"
#include "outline/curvature.h"

namespace rinkaku::outline {

/// The colour of a mean curvature, given as a multiple of K95: red for convex, white for flat, blue for concave,
/// deepest from -1 and 1 on. sRGB-encoded, opaque. (The thesis's figures 4.4 and 4.5, where the length of K n is shown,
/// run from white to red for hump and hollow alike.)
glm::vec4 curvature_colour(float multiple_of_k95);

/// The mesh with its mean curvature painted on in place of its own colours and textures. `curvature` is that of its
/// topology. `k95`: see k95(); 0 paints all white.
mesh::Mesh painted_with_curvature(mesh::Mesh mesh, const Curvature& curvature, double k95);

}  // namespace rinkaku::outline
