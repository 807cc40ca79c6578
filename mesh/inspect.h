#pragma once

#include <cstdint>

#include "mesh/bounds.h"
#include "mesh/import.h"
#include "mesh/topology.h"

namespace rinkaku::mesh {

/// A mesh's condition. Points, edges and everything from them is of the welded surface: vertices at one position are
/// one.
struct Inspection {
  std::uint64_t vertices = 0;  ///< as drawn: split at creases and texture seams
  std::uint64_t points = 0;
  std::uint64_t edges = 0;
  std::uint64_t triangles = 0;
  std::uint64_t components = 0;  ///< connected through points
  std::int64_t euler = 0;        ///< points - edges + triangles
  bool closed = false;           ///< every edge has exactly two faces
  bool manifold = false;         ///< no non-manifold edge or point
  std::uint64_t boundary_edges = 0;
  std::uint64_t non_manifold_edges = 0;   ///< of more than two faces
  std::uint64_t non_manifold_points = 0;  ///< where faces touch in several fans, ends of non-manifold edges not counted
  std::uint64_t inconsistent_edges = 0;   ///< of two faces whose windings disagree
  std::uint64_t degenerate = 0;           ///< triangles without area, those that import() dropped among them
  std::uint64_t duplicates = 0;           ///< triangles whose three points another triangle before has
  std::uint64_t slivers = 0;              ///< with area, but least altitude below 0.01 of the longest edge
  std::uint64_t isolated = 0;             ///< points or file vertices in no triangle
  std::uint64_t two_sided = 0;  ///< components that are drawn two-sided: open, non-manifold or inconsistently wound
  Box box;
};

/// Looks a mesh over. Preconditions as topology(). Cost: about a microsecond a triangle.
Inspection inspect(const Mesh& mesh);

/// The same, with what import() dropped counted in.
Inspection inspect(const Imported& imported);

}  // namespace rinkaku::mesh
