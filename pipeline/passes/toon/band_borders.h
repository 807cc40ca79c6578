#pragma once

#include <cstdint>
#include <vector>

#include <glm/mat4x4.hpp>

#include "mesh/mesh.h"
#include "pipeline/passes/toon/toon_pass.h"

namespace rinkaku::passes {

/// Per triangle: 1 if the border of a band of light or shade may run through it, by the brightness at its corners.
///
/// The light stands still in the world and so do objects, so the rest of a mesh has one colour a band wherever the eye
/// is, and may be simplified without a trace. Empty if the object is unlit: nothing is to be kept.
std::vector<std::uint8_t> band_borders(const mesh::Mesh& mesh, const glm::dmat4& world_from_object,
                                       const ToonOptions& options);

}  // namespace rinkaku::passes
