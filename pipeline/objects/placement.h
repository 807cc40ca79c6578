#pragma once

#include <glm/mat4x4.hpp>

#include "mesh/bounds.h"
#include "pipeline/scene/scene.h"

namespace rinkaku::pipeline {

/// Where the scene puts an object: world_from_object.
///
/// Read right to left: the mesh's up axis is turned to the world's z (its front to -y), its anchor moved to the origin,
/// scaled, turned about world x, then y, then z, and moved to the position. `up` is the axis for a scene that names
/// none. Throws Error (Input) if height_m is asked of a mesh that has no height.
glm::dmat4 world_from_object(const ObjectScene& object, const mesh::Box& box, char up);

}  // namespace rinkaku::pipeline
