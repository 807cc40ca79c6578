#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"
#include "outline/fluffy/growth.h"

namespace rinkaku::fluffy {

/// What is chosen of a mesh.
struct Chosen {
  std::vector<std::uint32_t> triangles;  ///< ascending
  std::vector<float> weights;            ///< per vertex of the mesh: how long fluff is there, 0 to 1
};

/// Chooses triangles by the names of their material or part, and by vertex paint: a triangle is left out where no
/// corner has any. Throws Error (Input) naming `where`, with the names that there are, if a name is not among them; if
/// the mesh has no vertex colours; if nothing is left.
Chosen choose(const mesh::Mesh& mesh, const Selection& selection, const char* where);

}  // namespace rinkaku::fluffy
