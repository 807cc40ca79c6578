#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "mesh/mesh.h"

namespace rinkaku::mesh {

inline constexpr std::uint32_t kNone = 0xffffffffu;

/// An edge of the welded surface, each geometric edge once.
struct Edge {
  std::uint32_t a = 0, b = 0;                ///< points, in the order face0 runs through them
  std::uint32_t vertex_a = 0, vertex_b = 0;  ///< the mesh's vertices there, as face0 has them
  std::uint32_t face0 = 0;                   ///< a triangle of the mesh
  std::uint32_t face1 = kNone;               ///< the other one; kNone on a boundary
  enum Flags : std::uint32_t {
    kBoundary = 1,      ///< one face only
    kNonManifold = 2,   ///< more than two faces; Topology::edge_faces has them all
    kInconsistent = 4,  ///< two faces that run through the edge the same way: their windings disagree
  };
  std::uint32_t flags = 0;
};

/// A face at an edge of more than two faces.
struct EdgeFace {
  std::uint32_t face = 0;
  bool reversed = false;  ///< runs from the edge's b to its a
};

/// What lies beside what on a mesh's welded surface. A value: it keeps no reference to the mesh.
struct Topology {
  std::vector<glm::vec3> points;           ///< position of each point
  std::vector<glm::uvec3> faces;           ///< the mesh's triangles as points, in the mesh's order
  std::vector<glm::vec3> face_normals;     ///< unit; a face without area has the one of a neighbour, or zero
  std::vector<glm::vec3> outline_normals;  ///< per point, unit: where a hull is pushed to (see topology())
  /// First the edges of exactly two consistently wound faces, then inconsistent ones, then boundary, then non-manifold.
  std::vector<Edge> edges;
  std::uint32_t consistent_edges = 0;
  std::uint32_t inconsistent_edges = 0;
  std::uint32_t boundary_edges = 0;
  std::uint32_t non_manifold_edges = 0;

  std::vector<std::uint32_t> component;  ///< per face: its part of the surface, connected through edges
  std::uint32_t component_count = 0;
  /// Per component: 1 if it must be drawn two-sided, as it is open, non-manifold or inconsistently wound.
  std::vector<std::uint8_t> component_two_sided;

  /// Per face: 1 if it must be turned round for its neighbours to be wound alike. Only faces of inconsistently wound
  /// pieces are turned: so that a closed piece's volume is positive, and an open one keeps what most of its area has.
  std::vector<std::uint8_t> turned;

  /// All faces of a non-manifold edge (index into `edges`); empty for other edges.
  std::span<const EdgeFace> edge_faces(std::uint32_t edge) const;

  std::vector<EdgeFace> non_manifold_faces;       ///< all faces of all non-manifold edges
  std::vector<std::uint32_t> non_manifold_first;  ///< per non-manifold edge where its run starts, and the end
};

/// Builds the topology of a mesh.
///
/// A point's outline normal is the mean of its faces' normals weighted by their angle there (Thürmer and Wüthrich,
/// "Computing vertex normals from polygonal facets", 1998), so hard edges don't open when a hull is pushed along it. On
/// the boundary it is the surface's outward direction (in the face, at right angles to the boundary), so that a hull or
/// feather grows past an open border in every view. Faces count as `turned`. Where the normals cancel out, the largest
/// face's is taken.
/// Preconditions: a mesh as import() gives it: welded, no triangle with two corners on one point.
/// Cost: about 0.2 microseconds a triangle.
Topology topology(const Mesh& mesh);

/// Per triangle of the mesh: its part.
std::vector<std::uint32_t> part_of_triangles(const Mesh& mesh);

/// The point of a face that does not lie on one of its edges.
std::uint32_t opposite_point(const Topology& topology, const Edge& edge, std::uint32_t face);

/// The vertex that a triangle of the mesh has at a welded point. Precondition: it has one there.
std::uint32_t corner_at(const Mesh& mesh, std::uint32_t triangle, std::uint32_t point);

}  // namespace rinkaku::mesh
