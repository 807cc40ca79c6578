#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace rinkaku::mesh {

/// A coarser version of a mesh: other triangles over the same vertices.
struct Level {
  std::vector<glm::uvec3> triangles;  ///< indices of the whole mesh's vertices
  /// Each of the whole mesh's parts twice, in order: first its kept triangles, then the rest, simplified. Some may be
  /// empty.
  std::vector<Part> parts;
  /// About how far its surface lies from the whole mesh's at most, in the mesh's units (by quadrics: rather too much).
  double error = 0;
};

/// Coarser levels of a mesh: each leaves about half of what the one before has of triangles that are not kept, down to
/// where halving no longer works or fewer than 500 triangles are left; empty for small meshes and for those with vertex
/// colours (which a coarser level would smear).
///
/// `kept` says per triangle whether it stays as it is (1), as one over which the shading changes does; empty for none.
/// Vertices are only left out, never moved; borders of parts, of kept triangles and of open surfaces stay as they are.
/// Textured parts are kept: the error does not tell how far a texture slides.
/// Garland and Heckbert, "Surface simplification using quadric error metrics", 1997 (through meshoptimizer).
/// Cost: about 1 microsecond a triangle.
std::vector<Level> levels(const Mesh& mesh, std::span<const std::uint8_t> kept = {});

}  // namespace rinkaku::mesh
