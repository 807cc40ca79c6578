#include "silhouette/front_mesh.h"

#include <array>

namespace rinkaku::silhouette {

FrontMeshBuilder::FrontMeshBuilder(const Surface& surface) : surface_(surface) {
  local_.assign(surface.triangles.size(), kNone);
  unit_points_.reserve(surface.points.size());
  for (const glm::vec3& p : surface.points) unit_points_.push_back(surface.frame.to_unit(p));
}

void FrontMeshBuilder::link(std::span<const FrontTriangle> front) {
  faces_.resize(front.size());
  for (std::uint32_t f = 0; f < front.size(); ++f) local_[front[f].triangle] = f;
  for (std::uint32_t f = 0; f < front.size(); ++f) {
    const glm::uvec3& v = surface_.triangles[front[f].triangle];
    const glm::uvec3& n = surface_.neighbours[front[f].triangle];
    faces_[f] = front[f].reversed ? Face{{v.x, v.z, v.y}, {n.z, n.y, n.x}} : Face{v, n};
    for (int side = 0; side < 3; ++side) {
      std::uint32_t& beside = faces_[f].neighbours[side];
      if (beside == kNone) continue;
      beside = local_[beside];
      if (beside != kNone && front[beside].reversed != front[f].reversed) beside = kNone;
    }
  }
  for (const FrontTriangle& f : front) local_[f.triangle] = kNone;
}

int FrontMeshBuilder::side_against(std::uint32_t of, std::uint32_t with, int side) const {
  const std::uint32_t start = faces_[with].corners[(side + 1) % 3];  // neighbours run through an edge the other way
  for (int s = 0; s < 3; ++s) {
    if (faces_[of].neighbours[s] == with && faces_[of].corners[s] == start) return s;
  }
  return -1;
}

void FrontMeshBuilder::number_edges() {
  edge_count_ = 0;
  half_edges_.assign(faces_.size(), glm::uvec3(kNone));
  for (std::uint32_t f = 0; f < faces_.size(); ++f) {
    for (int side = 0; side < 3; ++side) {
      if (half_edges_[f][side] != kNone) continue;
      half_edges_[f][side] = 2 * edge_count_;
      const std::uint32_t beside = faces_[f].neighbours[side];
      if (beside != kNone) half_edges_[beside][side_against(beside, f, side)] = 2 * edge_count_ + 1;
      ++edge_count_;
    }
  }
}

std::uint32_t FrontMeshBuilder::number_vertices(std::vector<std::uint32_t>& points) {
  points.clear();
  boundary_.clear();
  vertices_.assign(faces_.size(), glm::uvec3(kNone));
  std::uint32_t inner = 0;
  for (std::uint32_t first = 0; first < faces_.size(); ++first) {
    for (int first_corner = 0; first_corner < 3; ++first_corner) {
      if (vertices_[first][first_corner] != kNone) continue;
      // Back through the fan to where it begins on the boundary, or once round.
      std::uint32_t f = first;
      int corner = first_corner;
      bool open = false;
      for (;;) {
        const std::uint32_t before = faces_[f].neighbours[corner];
        if (before == kNone) {
          open = true;
          break;
        }
        corner = (side_against(before, f, corner) + 1) % 3;
        f = before;
        if (f == first && corner == first_corner) break;
      }
      const auto vertex = static_cast<std::uint32_t>(points.size());
      points.push_back(faces_[first].corners[first_corner]);
      boundary_.push_back(open);
      inner += open ? 0 : 1;
      // Forward through all of it.
      while (vertices_[f][corner] == kNone) {
        vertices_[f][corner] = vertex;
        const int side = (corner + 2) % 3;
        const std::uint32_t after = faces_[f].neighbours[side];
        if (after == kNone) break;
        corner = side_against(after, f, side);
        f = after;
      }
    }
  }
  return inner;
}

void FrontMeshBuilder::fill(CollapseMesh& mesh, const std::vector<std::uint32_t>& points) const {
  using Vertex = CollapseMesh::VertexHandle;
  using HalfEdge = CollapseMesh::HalfedgeHandle;
  mesh.clean_keep_reservation();
  mesh.resize(points.size(), edge_count_, faces_.size());
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    const glm::dvec3& p = unit_points_[points[v]];
    const Vertex handle(static_cast<int>(v));
    mesh.set_point(handle, CollapseMesh::Point(p.x, p.y, p.z));
    mesh.status(handle).set_bits(0);
    mesh.status(handle).set_locked(boundary_[v] != 0);
  }
  for (const auto edge : mesh.all_edges()) mesh.status(edge).set_bits(0);  // a mesh before may have left its marks
  for (const auto face : mesh.all_faces()) mesh.status(face).set_bits(0);
  // Boundary half-edges are linked at the vertex where one ends and the next starts.
  std::vector<HalfEdge> outer_from(points.size());
  std::vector<HalfEdge> outer;
  for (std::uint32_t f = 0; f < faces_.size(); ++f) {
    const CollapseMesh::FaceHandle face(static_cast<int>(f));
    std::array<HalfEdge, 3> sides;
    for (int s = 0; s < 3; ++s) sides[s] = HalfEdge(static_cast<int>(half_edges_[f][s]));
    mesh.set_halfedge_handle(face, sides[0]);
    for (int s = 0; s < 3; ++s) {
      const Vertex from(static_cast<int>(vertices_[f][s]));
      const Vertex to(static_cast<int>(vertices_[f][(s + 1) % 3]));
      mesh.set_vertex_handle(sides[s], to);
      mesh.set_face_handle(sides[s], face);
      mesh.set_next_halfedge_handle(sides[s], sides[(s + 1) % 3]);
      if (!boundary_[from.idx()]) mesh.set_halfedge_handle(from, sides[s]);
      if (faces_[f].neighbours[s] != kNone) continue;
      const HalfEdge outside = mesh.opposite_halfedge_handle(sides[s]);
      mesh.set_vertex_handle(outside, from);
      mesh.set_boundary(outside);
      mesh.set_halfedge_handle(to, outside);
      outer_from[to.idx()] = outside;
      outer.push_back(outside);
    }
  }
  for (const HalfEdge h : outer) mesh.set_next_halfedge_handle(h, outer_from[mesh.to_vertex_handle(h).idx()]);
}

std::uint32_t FrontMeshBuilder::build(std::span<const FrontTriangle> front, CollapseMesh& mesh,
                                      std::vector<std::uint32_t>& points) {
  link(front);
  number_edges();
  const std::uint32_t inner = number_vertices(points);
  fill(mesh, points);
  return inner;
}

}  // namespace rinkaku::silhouette
