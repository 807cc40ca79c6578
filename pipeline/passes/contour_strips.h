#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/contour.h"
#include "mesh/mesh.h"
#include "mesh/topology.h"
#include "pipeline/passes/shape_vertex.h"

namespace rinkaku::passes {

/// Turns a contour into strips of quads for feathers and lines: two vertices on the edge (the fourth component of their
/// outline normal 0) and the same two again (1) for the vertex shader to push out.
/// No GL.
class ContourStrips {
 public:
  /// `two_sided`: also what faces away is seen. `moving`: the vertices given to collect() move. Keeps neither mesh nor
  /// topology.
  ContourStrips(const mesh::Mesh& mesh, const mesh::Topology& topology, bool two_sided, bool moving = false);

  /// What collect() will look at: calls end(vertex) for one vertex at each end of the contour's edges, standing for all
  /// that are at its point; and, of a moving mesh, position(vertex) for those that lie opposite.
  template <typename End, typename Position>
  void for_each_used(const mesh::Contour& contour, const End& end, const Position& position) const;

  /// `vertices` are the mesh's; only those need be right that for_each_used() names. Allocates nothing once warm.
  void collect(const mesh::Contour& contour, std::span<const ShapeVertex> vertices);

  std::span<const ShapeVertex> vertices() const { return strip_vertices_; }
  std::span<const std::uint32_t> indices() const { return indices_; }
  std::span<const Run> runs() const { return runs_; }

  /// An edge of this frame's contour, in the direction in which the face that is seen runs along it.
  struct Piece {
    std::uint32_t part, from, to;  ///< `from` and `to` are vertices of the mesh
    bool from_behind;              ///< as the border of an open surface may be seen
  };
  std::span<const Piece> pieces() const { return pieces_; }
  /// How a contour goes on where it is never seen, in no order: what faces away lies before it.
  std::span<const Piece> hidden_pieces() const { return hidden_pieces_; }

 private:
  struct EdgeVertices {
    std::uint32_t a0, b0, a1, b1;  // as face0 and face1 have them
    std::uint32_t part0, part1;
    std::uint32_t face0, face1;
    bool always_hidden;
    std::uint32_t opposite0 = mesh::kNone, opposite1 = mesh::kNone;  // if the mesh moves and that may hide the edge
  };
  void collect_pieces(const mesh::Contour& contour, std::span<const ShapeVertex> vertices);
  void emit(std::span<const ShapeVertex> vertices, const Piece& piece);

  std::vector<EdgeVertices> edges_;
  std::size_t parts_;
  // This frame's, kept for their memory.
  std::vector<Piece> pieces_, hidden_pieces_;
  std::vector<ShapeVertex> strip_vertices_;
  std::vector<std::uint32_t> indices_;
  std::vector<Run> runs_;
};

template <typename End, typename Position>
void ContourStrips::for_each_used(const mesh::Contour& contour, const End& end, const Position& position) const {
  for (const std::uint32_t edge : contour.edges) {
    const EdgeVertices& e = edges_[edge];
    end(e.a0);
    end(e.b0);
    if (e.opposite0 == mesh::kNone) continue;
    position(e.opposite0);
    position(e.opposite1);
  }
}

}  // namespace rinkaku::passes
