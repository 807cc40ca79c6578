#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

#include "mesh/contour.h"
#include "mesh/mesh.h"
#include "mesh/topology.h"
#include "pipeline/passes/shape_vertex.h"

namespace rinkaku::passes {

/// The feathers of borders between materials: along every edge at which two parts of different looks meet, each part
/// has a quad that reaches over the other. Two of its vertices lie on the edge (the fourth component of their outline
/// normal is 0), two are the same again (1), to be moved `across`: in the other part's triangle, away from the edge. No
/// GL.
class BorderStrips {
 public:
  /// `vertices` are the mesh's. `creases`: also along edges that are shaded hard. Keeps neither mesh nor topology.
  BorderStrips(const mesh::Mesh& mesh, const mesh::Topology& topology, std::span<const ShapeVertex> vertices,
               const glm::dmat4& world_from_object, bool creases);

  /// Lists the quads whose two triangles both face the eye. Allocates nothing once warm.
  void collect(const mesh::Contour& contour);

  /// Adds the vertices of the mesh that move() looks at: those at the borders, and those of which it takes only the
  /// position.
  void append_used(std::vector<std::uint32_t>& vertices, std::vector<std::uint32_t>& positions) const;
  /// The mesh has moved: `vertices` are its new ones. About 50 ns a border's edge.
  void move(std::span<const ShapeVertex> vertices);

  /// Marks (1) the triangles on either side, by number.
  void mark_triangles(std::vector<std::uint8_t>& mask) const;

  std::span<const BorderVertex> vertices() const { return vertices_; }  ///< until the mesh moves
  std::span<const std::uint32_t> indices() const { return indices_; }
  std::span<const Run> runs() const { return runs_; }

 private:
  struct Quad {
    std::uint32_t part;
    std::uint32_t face0, face1;
    // Vertices of the mesh: at the edge's ends in the face whose colour the quad has; the other face's third.
    std::uint32_t a, b, beyond;
  };
  glm::dmat3 world_from_object_, object_from_world_;
  std::vector<Quad> quads_;  // in the order of parts
  std::vector<BorderVertex> vertices_;
  std::vector<std::uint32_t> indices_;
  std::vector<Run> runs_;
};

}  // namespace rinkaku::passes
