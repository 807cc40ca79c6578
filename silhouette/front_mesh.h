#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "silhouette/collapse_mesh.h"
#include "silhouette/surface.h"

namespace rinkaku::silhouette {

/// A triangle of a surface as it faces a region: as it is, or the reversed copy of a two-sided one.
struct FrontTriangle {
  std::uint32_t triangle = 0;
  bool reversed = false;
};

/// Builds half-edge meshes of parts of a surface, one after the other, in the same memory.
class FrontMeshBuilder {
 public:
  /// Keeps a reference to the surface.
  explicit FrontMeshBuilder(const Surface& surface);

  /// Makes `mesh` of the front triangles, in the unit frame. Where they meet in a point but not along edges, each fan
  /// gets a vertex of its own, so the mesh is manifold. Vertices on the boundary are locked.
  /// Sets the surface's point of each vertex, and returns how many vertices are not on the boundary.
  /// Cost: linear, about 0.1 microseconds a triangle.
  std::uint32_t build(std::span<const FrontTriangle> front, CollapseMesh& mesh, std::vector<std::uint32_t>& points);

 private:
  struct Face {
    glm::uvec3 corners;     // the surface's points
    glm::uvec3 neighbours;  // local numbers, kNone on the boundary
  };
  void link(std::span<const FrontTriangle> front);
  void number_edges();
  std::uint32_t number_vertices(std::vector<std::uint32_t>& points);
  void fill(CollapseMesh& mesh, const std::vector<std::uint32_t>& points) const;
  /// The side of face `of` that lies against face `with`'s side.
  int side_against(std::uint32_t of, std::uint32_t with, int side) const;

  const Surface& surface_;
  std::vector<std::uint32_t> local_;  // per triangle of the surface: its number in the front, kNone outside
  std::vector<Face> faces_;
  std::vector<glm::uvec3> half_edges_;  // per face: the half-edge along each side
  std::vector<glm::uvec3> vertices_;    // per face: the vertex at each corner
  std::vector<std::uint8_t> boundary_;  // per vertex
  std::vector<glm::dvec3> unit_points_;
  std::uint32_t edge_count_ = 0;
};

}  // namespace rinkaku::silhouette
