#include "mesh/inspect.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include <glm/geometric.hpp>

#include "mesh/face_normals.h"

namespace rinkaku::mesh {
namespace {

/// Counts the points where faces meet in several fans that share no edge there.
std::uint64_t non_manifold_points(const Topology& t) {
  std::vector<std::uint32_t> parent(t.faces.size() * 3);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t corner) {
    while (parent[corner] != corner) corner = parent[corner] = parent[parent[corner]];
    return corner;
  };
  const auto corner_of = [&](std::uint32_t face, std::uint32_t point) {
    const glm::uvec3& f = t.faces[face];
    return face * 3 + (f.x == point ? 0u : f.y == point ? 1u : 2u);
  };
  std::vector<std::uint8_t> on_non_manifold_edge(t.points.size(), 0);
  for (const Edge& edge : t.edges) {
    if (edge.flags & Edge::kNonManifold) on_non_manifold_edge[edge.a] = on_non_manifold_edge[edge.b] = 1;
    if (edge.face1 == kNone) continue;
    for (const std::uint32_t point : {edge.a, edge.b}) {
      parent[root(corner_of(edge.face0, point))] = root(corner_of(edge.face1, point));
    }
  }
  std::vector<std::uint32_t> fans(t.points.size(), 0);
  for (std::uint32_t corner = 0; corner < parent.size(); ++corner) {
    if (parent[corner] == corner) ++fans[t.faces[corner / 3][static_cast<int>(corner % 3)]];
  }
  std::uint64_t count = 0;
  for (std::size_t p = 0; p < fans.size(); ++p) count += fans[p] > 1 && !on_non_manifold_edge[p] ? 1 : 0;
  return count;
}

struct Components {
  std::uint64_t count = 0, two_sided = 0;
};

/// Components that hang together through points: those of the topology, which does so through edges only, joined.
Components components_through_points(const Topology& t) {
  std::vector<std::uint32_t> parent(t.component_count);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t component) {
    while (parent[component] != component) component = parent[component] = parent[parent[component]];
    return component;
  };
  std::vector<std::uint32_t> of_point(t.points.size(), kNone);
  for (std::size_t f = 0; f < t.faces.size(); ++f) {
    for (int c = 0; c < 3; ++c) {
      std::uint32_t& first = of_point[t.faces[f][c]];
      if (first == kNone) first = t.component[f];
      parent[root(t.component[f])] = root(first);
    }
  }
  std::vector<std::uint8_t> two_sided(t.component_count, 0);
  for (std::uint32_t c = 0; c < t.component_count; ++c) two_sided[root(c)] |= t.component_two_sided[c];
  Components result;
  for (std::uint32_t c = 0; c < t.component_count; ++c) {
    if (parent[c] != c) continue;
    ++result.count;
    result.two_sided += two_sided[c];
  }
  return result;
}

std::uint64_t duplicate_faces(const Topology& t) {
  std::vector<std::array<std::uint32_t, 3>> sorted(t.faces.size());
  for (std::size_t f = 0; f < sorted.size(); ++f) {
    sorted[f] = {t.faces[f].x, t.faces[f].y, t.faces[f].z};
    std::sort(sorted[f].begin(), sorted[f].end());
  }
  std::sort(sorted.begin(), sorted.end());
  const auto first_double = std::unique(sorted.begin(), sorted.end());
  return static_cast<std::uint64_t>(sorted.end() - first_double);
}

}  // namespace

Inspection inspect(const Mesh& mesh) {
  const Topology t = topology(mesh);
  Inspection result;
  result.vertices = mesh.positions.size();
  result.points = t.points.size();
  result.edges = t.edges.size();
  result.triangles = t.faces.size();
  const Components components = components_through_points(t);
  result.components = components.count;
  result.two_sided = components.two_sided;
  result.boundary_edges = t.boundary_edges;
  result.non_manifold_edges = t.non_manifold_edges;
  result.non_manifold_points = non_manifold_points(t);
  result.inconsistent_edges = t.inconsistent_edges;
  result.closed = t.boundary_edges == 0 && t.non_manifold_edges == 0 && !t.faces.empty();
  result.manifold = t.non_manifold_edges == 0 && result.non_manifold_points == 0;
  result.duplicates = duplicate_faces(t);

  std::vector<std::uint8_t> used(t.points.size(), 0);
  constexpr double kSliver = 0.01;
  for (const glm::uvec3& face : t.faces) {
    for (int c = 0; c < 3; ++c) used[face[c]] = 1;
    const FaceShape shape = face_shape(t.points, face);
    if (shape.degenerate()) {
      ++result.degenerate;
    } else if (glm::length(shape.cross) < kSliver * shape.longest_sq) {  // altitude times longest edge
      ++result.slivers;
    }
  }
  result.isolated = static_cast<std::uint64_t>(std::count(used.begin(), used.end(), std::uint8_t{0}));
  result.euler = static_cast<std::int64_t>(result.points - result.isolated) - static_cast<std::int64_t>(result.edges) +
                 static_cast<std::int64_t>(result.triangles);
  result.box = bounding_box(mesh.positions);
  return result;
}

Inspection inspect(const Imported& imported) {
  Inspection result = inspect(imported.mesh);
  result.degenerate += imported.summary.dropped_collapsed;
  result.isolated += imported.summary.unused_vertices;
  return result;
}

}  // namespace rinkaku::mesh
