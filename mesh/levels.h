#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace rinkaku::mesh {

/// A coarser version of a mesh: other triangles over the same vertices.
struct Level {
  std::vector<glm::uvec3> triangles;  ///< indices of the whole mesh's vertices
  std::vector<Part> parts;            ///< the whole mesh's parts, in order; some may be empty
  /// About how far its surface lies from the whole mesh's at most, in the mesh's units (by quadrics: rather too much).
  double error = 0;
};

/// Coarser levels of a mesh, each about half the triangles of the one before, down to where halving no longer works or
/// fewer than 500 triangles are left; empty for small meshes and for those with vertex colours (which a coarser level
/// would smear).
///
/// Vertices are only left out, never moved; borders of parts and of open surfaces stay as they are. Textured parts stay
/// whole: the error does not tell how far a texture slides.
/// Garland and Heckbert, "Surface simplification using quadric error metrics", 1997 (through meshoptimizer).
/// Cost: about 1 microsecond a triangle.
std::vector<Level> levels(const Mesh& mesh);

}  // namespace rinkaku::mesh
