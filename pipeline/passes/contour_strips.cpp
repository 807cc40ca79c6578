#include "pipeline/passes/contour_strips.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace rinkaku::passes {
namespace {

constexpr float least_hollow = 1e-4f;  // of the length: flat within rounding counts as convex

bool may_be_hollow(const mesh::Topology& topology, const mesh::Edge& edge) {
  if ((edge.flags & (mesh::Edge::kNonManifold | mesh::Edge::kInconsistent)) != 0) return false;
  return topology.component_two_sided[topology.component[edge.face0]] == 0;
}

// Whether a surface bends towards its outer side at an edge. Of a closed surface, the contour there is never seen: what
// faces away lies before what faces the eye.
bool is_hollow(const mesh::Topology& topology, const mesh::Edge& edge) {
  if (!may_be_hollow(topology, edge)) return false;
  const std::uint32_t opposite = mesh::opposite_point(topology, edge, edge.face1);
  const glm::vec3 away = topology.points[opposite] - topology.points[edge.a];
  return glm::dot(topology.face_normals[edge.face0], away) > least_hollow * glm::length(away);
}

// The same for an edge from a to b of a triangle to c, beyond which lies d.
bool is_hollow(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
  const glm::vec3 cross = glm::cross(b - a, c - a), away = d - a;
  return glm::dot(cross, away) > least_hollow * glm::length(cross) * glm::length(away);
}

}  // namespace

ContourStrips::ContourStrips(const mesh::Mesh& mesh, const mesh::Topology& topology, bool two_sided, bool moving)
    : parts_(mesh.parts.size()) {
  const std::vector<std::uint32_t> part_of = mesh::part_of_triangles(mesh);
  edges_.reserve(topology.edges.size());
  for (const mesh::Edge& edge : topology.edges) {
    EdgeVertices e{edge.vertex_a,       edge.vertex_b, edge.vertex_a, edge.vertex_b, part_of[edge.face0],
                   part_of[edge.face0], edge.face0,    edge.face0,    false};
    if (edge.face1 != mesh::kNone) {
      e.a1 = mesh::corner_at(mesh, edge.face1, edge.a);
      e.b1 = mesh::corner_at(mesh, edge.face1, edge.b);
      e.part1 = part_of[edge.face1];
      e.face1 = edge.face1;
      e.always_hidden = !two_sided && !moving && is_hollow(topology, edge);
      if (!two_sided && moving && may_be_hollow(topology, edge)) {
        e.opposite0 = mesh::corner_at(mesh, edge.face0, mesh::opposite_point(topology, edge, edge.face0));
        e.opposite1 = mesh::corner_at(mesh, edge.face1, mesh::opposite_point(topology, edge, edge.face1));
      }
    }
    edges_.push_back(e);
  }
}

void ContourStrips::collect(const mesh::Contour& contour, std::span<const ShapeVertex> vertices) {
  collect_pieces(contour, vertices);
  strip_vertices_.clear();
  indices_.clear();
  runs_.clear();
  for (const Piece& piece : pieces_) emit(vertices, piece);
}

void ContourStrips::collect_pieces(const mesh::Contour& contour, std::span<const ShapeVertex> vertices) {
  pieces_.clear();
  hidden_pieces_.clear();
  for (std::uint32_t edge : contour.edges) {
    const EdgeVertices& e = edges_[edge];
    const bool hidden = e.always_hidden || (e.opposite0 != mesh::kNone &&
                                            is_hollow(vertices[e.a0].position, vertices[e.b0].position,
                                                      vertices[e.opposite0].position, vertices[e.opposite1].position));
    const bool first = contour.front[e.face0] != 0 || contour.front[e.face1] == 0;
    const bool from_behind = contour.front[first ? e.face0 : e.face1] == 0;
    (hidden ? hidden_pieces_ : pieces_)
        .push_back(first ? Piece{e.part0, e.a0, e.b0, from_behind} : Piece{e.part1, e.b1, e.a1, from_behind});
  }
  if (parts_ > 1) {
    std::stable_sort(pieces_.begin(), pieces_.end(), [](const Piece& a, const Piece& b) { return a.part < b.part; });
  }
}

void ContourStrips::emit(std::span<const ShapeVertex> vertices, const Piece& piece) {
  ShapeVertex a = vertices[piece.from], b = vertices[piece.to];
  if (piece.from_behind) {
    for (int k = 0; k < 3; ++k) {
      a.normal[k] = static_cast<std::int16_t>(-a.normal[k]);
      b.normal[k] = static_cast<std::int16_t>(-b.normal[k]);
    }
  }
  const auto base = static_cast<std::uint32_t>(strip_vertices_.size());
  strip_vertices_.push_back(a);
  strip_vertices_.push_back(b);
  a.outline_normal[3] = b.outline_normal[3] = 32767;
  strip_vertices_.push_back(a);
  strip_vertices_.push_back(b);
  append_quad(piece.part, base, indices_, runs_);
}

}  // namespace rinkaku::passes
