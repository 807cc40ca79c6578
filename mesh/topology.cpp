#include "mesh/topology.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>

#include "mesh/face_normals.h"
#include "mesh/half_edges.h"

namespace rinkaku::mesh {
namespace {

void number_points(const Mesh& mesh, Topology& out) {
  out.points.resize(mesh.point_count);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) out.points[mesh.welded[v]] = mesh.positions[v];
  out.faces.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < out.faces.size(); ++t) {
    const glm::uvec3& v = mesh.triangles[t];
    out.faces[t] = {mesh.welded[v.x], mesh.welded[v.y], mesh.welded[v.z]};
  }
}

Edge make_edge(const Mesh& mesh, std::span<const HalfEdge> faces) {
  const HalfEdge& first = faces.front();
  const glm::uvec3& triangle = mesh.triangles[first.face];
  Edge edge;
  edge.vertex_a = triangle[first.corner];
  edge.vertex_b = triangle[(first.corner + 1) % 3];
  edge.a = mesh.welded[edge.vertex_a];
  edge.b = mesh.welded[edge.vertex_b];
  edge.face0 = first.face;
  if (faces.size() > 1) edge.face1 = faces[1].face;
  if (faces.size() == 1) edge.flags = Edge::kBoundary;
  if (faces.size() == 2 && faces[0].reversed == faces[1].reversed) edge.flags = Edge::kInconsistent;
  if (faces.size() > 2) edge.flags = Edge::kNonManifold;
  return edge;
}

void list_edges(const Mesh& mesh, std::span<const HalfEdge> half_edges, Topology& out) {
  std::vector<Edge> inconsistent;
  std::vector<Edge> boundary;
  std::vector<Edge> non_manifold;
  out.edges.reserve(half_edges.size() / 2);
  out.non_manifold_first = {0};
  for (std::size_t i = 0; i < half_edges.size();) {
    const auto faces = edge_at(half_edges, i);
    i += faces.size();
    const Edge edge = make_edge(mesh, faces);
    switch (edge.flags) {
      case Edge::kBoundary:
        boundary.push_back(edge);
        break;
      case Edge::kInconsistent:
        inconsistent.push_back(edge);
        break;
      case Edge::kNonManifold:
        non_manifold.push_back(edge);
        for (const HalfEdge& h : faces) out.non_manifold_faces.push_back({h.face, h.reversed != faces[0].reversed});
        out.non_manifold_first.push_back(static_cast<std::uint32_t>(out.non_manifold_faces.size()));
        break;
      default:
        out.edges.push_back(edge);
    }
  }
  out.consistent_edges = static_cast<std::uint32_t>(out.edges.size());
  out.inconsistent_edges = static_cast<std::uint32_t>(inconsistent.size());
  out.boundary_edges = static_cast<std::uint32_t>(boundary.size());
  out.non_manifold_edges = static_cast<std::uint32_t>(non_manifold.size());
  for (const auto* list : {&inconsistent, &boundary, &non_manifold}) {
    out.edges.insert(out.edges.end(), list->begin(), list->end());
  }
}

void list_components(std::span<const HalfEdge> half_edges, Topology& out) {
  std::vector<std::uint32_t> parent(out.faces.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t face) {
    while (parent[face] != face) face = parent[face] = parent[parent[face]];
    return face;
  };
  for (std::size_t i = 1; i < half_edges.size(); ++i) {
    const HalfEdge& l = half_edges[i - 1];
    const HalfEdge& r = half_edges[i];
    if (l.low != r.low || l.high != r.high) continue;
    const std::uint32_t a = root(l.face);
    const std::uint32_t b = root(r.face);
    parent[std::max(a, b)] = std::min(a, b);  // so a component's root is its first face
  }
  out.component.resize(out.faces.size());
  for (std::uint32_t face = 0; face < out.faces.size(); ++face) {
    const std::uint32_t first = root(face);
    out.component[face] = first == face ? out.component_count++ : out.component[first];
  }
  out.component_two_sided.assign(out.component_count, 0);
  for (std::size_t e = out.consistent_edges; e < out.edges.size(); ++e) {
    out.component_two_sided[out.component[out.edges[e].face0]] = 1;
  }
}

/// Finds the faces to turn so that neighbours are wound alike, in components where they are not.
class WindingAligner {
 public:
  explicit WindingAligner(Topology& topology) : topology_(topology) {}

  void run() {
    topology_.turned.assign(topology_.faces.size(), 0);
    if (topology_.inconsistent_edges == 0) return;
    link_faces();
    std::vector<std::uint8_t> reached(topology_.faces.size(), 0);
    std::vector<std::uint32_t> patch;
    for (std::uint32_t seed = 0; seed < reached.size(); ++seed) {
      if (reached[seed]) continue;
      patch.assign(1, seed);
      reached[seed] = 1;
      for (std::size_t i = 0; i < patch.size(); ++i) {
        const std::uint32_t face = patch[i];
        for (std::uint32_t k = first_[face]; k < first_[face + 1]; ++k) {
          const Link& link = links_[k];
          if (reached[link.face]) continue;
          reached[link.face] = 1;
          topology_.turned[link.face] = topology_.turned[face] ^ link.disagrees;
          patch.push_back(link.face);
        }
      }
      choose_side(patch);
    }
  }

 private:
  struct Link {
    std::uint32_t face = 0;
    std::uint8_t disagrees = 0;
  };

  void link_faces() {
    const std::size_t two_faced = topology_.consistent_edges + topology_.inconsistent_edges;
    first_.assign(topology_.faces.size() + 1, 0);
    for (std::size_t e = 0; e < two_faced; ++e) {
      ++first_[topology_.edges[e].face0 + 1];
      ++first_[topology_.edges[e].face1 + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    links_.resize(two_faced * 2);
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t e = 0; e < two_faced; ++e) {
      const Edge& edge = topology_.edges[e];
      const std::uint8_t disagrees = e >= topology_.consistent_edges ? 1 : 0;
      links_[next[edge.face0]++] = {edge.face1, disagrees};
      links_[next[edge.face1]++] = {edge.face0, disagrees};
    }
  }

  /// Of the two ways to wind a patch alike: a closed one's volume is positive, an open one keeps what most of its area
  /// has.
  void choose_side(const std::vector<std::uint32_t>& patch) {
    const glm::dvec3 origin(topology_.points[topology_.faces[patch.front()].x]);
    double volume = 0;
    double kept_area = 0;
    bool disagree = false;
    for (const std::uint32_t face : patch) {
      const glm::uvec3& f = topology_.faces[face];
      const FaceShape shape = face_shape(topology_.points, f);
      const double sign = topology_.turned[face] ? -1.0 : 1.0;
      disagree = disagree || topology_.turned[face];
      volume += sign * glm::dot(glm::dvec3(topology_.points[f.x]) - origin, shape.cross);
      kept_area += sign * glm::length(shape.cross);
    }
    if (!disagree) return;  // a patch wound alike is left as it is
    const bool closed = is_closed(patch);
    if (closed ? volume < 0 : kept_area < 0) {
      for (const std::uint32_t face : patch) topology_.turned[face] ^= 1;
    }
  }

  bool is_closed(const std::vector<std::uint32_t>& patch) const {
    return std::all_of(patch.begin(), patch.end(), [&](std::uint32_t f) { return first_[f + 1] - first_[f] == 3; });
  }

  Topology& topology_;
  std::vector<std::uint32_t> first_;
  std::vector<Link> links_;
};

void point_outline_normals(const FaceNormals& of_face, Topology& out) {
  const std::size_t count = out.points.size();
  std::vector<glm::dvec3> mean(count, glm::dvec3(0));
  std::vector<glm::dvec3> outward(count, glm::dvec3(0));
  std::vector<glm::dvec3> largest(count, glm::dvec3(0));
  std::vector<double> largest_sq(count, -1.0);
  for (std::size_t f = 0; f < out.faces.size(); ++f) {
    const glm::dvec3 normal = out.turned[f] ? -of_face.normal[f] : of_face.normal[f];
    const FaceShape shape = face_shape(out.points, out.faces[f]);
    const double area_sq = glm::dot(shape.cross, shape.cross);
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t p = out.faces[f][c];
      if (!of_face.degenerate[f]) mean[p] += normal * corner_angle(out.points, out.faces[f], c);
      if (area_sq > largest_sq[p]) {
        largest_sq[p] = area_sq;
        largest[p] = normal;
      }
    }
  }
  const std::size_t boundary = out.consistent_edges + out.inconsistent_edges;
  for (std::size_t e = boundary; e < boundary + out.boundary_edges; ++e) {
    const Edge& edge = out.edges[e];
    const glm::dvec3 along = glm::dvec3(out.points[edge.b]) - glm::dvec3(out.points[edge.a]);
    // The face lies left of its edges, so its border's outer side is right of them, whichever way it is turned.
    const glm::dvec3 away = glm::cross(glm::normalize(along), of_face.normal[edge.face0]);
    outward[edge.a] += away;
    outward[edge.b] += away;
  }
  out.outline_normals.resize(count);
  constexpr double kCancelled = 1e-6;
  for (std::size_t p = 0; p < count; ++p) {
    // At a border outwards, in the surface: a part of its normal as well would cancel that out in oblique views.
    glm::dvec3 normal = glm::length(mean[p]) > kCancelled ? mean[p] : largest[p];
    if (glm::length(outward[p]) > kCancelled) normal = outward[p];
    const double length = glm::length(normal);
    out.outline_normals[p] = length > kCancelled ? glm::vec3(normal / length) : glm::vec3(0, 0, 1);
  }
}

}  // namespace

std::span<const EdgeFace> Topology::edge_faces(std::uint32_t edge) const {
  const std::size_t first = edges.size() - non_manifold_edges;
  if (edge < first) return {};
  const std::size_t run = edge - first;
  return std::span(non_manifold_faces)
      .subspan(non_manifold_first[run], non_manifold_first[run + 1] - non_manifold_first[run]);
}

Topology topology(const Mesh& mesh) {
  Topology out;
  number_points(mesh, out);
  const auto half_edges = half_edges_by_edge(out.faces, mesh.point_count);
  list_edges(mesh, half_edges, out);
  list_components(half_edges, out);
  WindingAligner(out).run();
  const FaceNormals of_face = face_normals(out.points, out.faces, half_edges);
  out.face_normals.assign(of_face.normal.begin(), of_face.normal.end());
  point_outline_normals(of_face, out);
  return out;
}

std::vector<std::uint32_t> part_of_triangles(const Mesh& mesh) {
  std::vector<std::uint32_t> part_of(mesh.triangles.size());
  for (std::uint32_t p = 0; p < mesh.parts.size(); ++p) {
    std::fill_n(part_of.begin() + mesh.parts[p].first_triangle, mesh.parts[p].triangle_count, p);
  }
  return part_of;
}

std::uint32_t opposite_point(const Topology& topology, const Edge& edge, std::uint32_t face) {
  const glm::uvec3& f = topology.faces[face];
  return f.x + f.y + f.z - edge.a - edge.b;
}

std::uint32_t corner_at(const Mesh& mesh, std::uint32_t triangle, std::uint32_t point) {
  const glm::uvec3& t = mesh.triangles[triangle];
  for (int k = 0; k < 2; ++k) {
    if (mesh.welded[t[k]] == point) return t[k];
  }
  assert(mesh.welded[t.z] == point);
  return t.z;
}

}  // namespace rinkaku::mesh
