#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "mesh/mesh.h"
#include "mesh/topology.h"
#include "outline/strokes/chains.h"
#include "outline/strokes/cut_places.h"

namespace rinkaku::outline {

/// Which lines within a shape are drawn. (Borders of open surfaces belong to the contour.)
struct FeatureOptions {
  bool creases = true;
  double crease_deg = 60;  ///< two faces that enclose a larger angle than this make a crease
  bool materials = true;   ///< where parts of different looks meet
  bool cuts = true;        ///< where pieces of the mesh cut through each other
};

/// A line's piece between two faces.
struct Feature {
  Segment segment;
  std::uint32_t face0 = 0, face1 = 0;  ///< triangles of the mesh
};

/// The lines of a mesh that don't depend on where it is seen from. Of one that moves, creases are those that it has at
/// rest: they are part of its make, and lines don't come and go at its joints. No GL.
struct Features {
  std::vector<Feature> list;  ///< in the order in which they follow one another
  /// Positions of the vertices after the mesh's own: the ends of cuts. In the mesh's coordinates.
  std::vector<glm::vec3> more_positions;
  std::vector<CutPlace> cut_places;   ///< the same as places on faces
  std::vector<std::uint32_t> welded;  ///< of the mesh's vertices and of those
};

/// Finds them. Some 0.2 microseconds a triangle, and what mesh::intersections() costs.
Features find_features(const mesh::Mesh& mesh, const mesh::Topology& topology, const FeatureOptions& options);

}  // namespace rinkaku::outline
