#include "silhouette/shorten_edges.h"

#include <algorithm>
#include <vector>

#include <glm/geometric.hpp>

namespace rinkaku::silhouette {
namespace {

bool may_be(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const EyeHull& hull) {
  const glm::dvec3 ab = b - a, ac = c - a, bc = c - b;
  const glm::dvec3 normal = glm::cross(ab, ac);
  const double longest_sq = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)});
  return hull.sees_front(a, normal, longest_sq);
}

// Turns the edge over if the other diagonal of its two triangles is shorter and both new ones may be.
bool shorten(CollapseMesh& mesh, CollapseMesh::EdgeHandle edge, const EyeHull& hull) {
  const auto along = mesh.halfedge_handle(edge, 0), back = mesh.halfedge_handle(edge, 1);
  const glm::dvec3 a = place_of(mesh, mesh.from_vertex_handle(along));
  const glm::dvec3 b = place_of(mesh, mesh.to_vertex_handle(along));
  const glm::dvec3 left = place_of(mesh, mesh.to_vertex_handle(mesh.next_halfedge_handle(along)));
  const glm::dvec3 right = place_of(mesh, mesh.to_vertex_handle(mesh.next_halfedge_handle(back)));
  const auto seen_sq = [&hull](const glm::dvec3& way) {
    const double depth = glm::dot(way, hull.middle());
    return glm::dot(way, way) - depth * depth;
  };
  constexpr double worth_it = 0.99;  // also keeps rounding from turning an edge to and fro
  if (seen_sq(right - left) >= worth_it * seen_sq(b - a)) return false;
  if (!may_be(a, right, left, hull) || !may_be(b, left, right, hull) || !mesh.is_flip_ok(edge)) return false;
  mesh.flip(edge);
  return true;
}

}  // namespace

void shorten_edges(CollapseMesh& mesh, const EyeHull& hull) {
  std::vector<CollapseMesh::EdgeHandle> inner;
  for (const auto edge : mesh.all_edges()) {
    if (!mesh.status(edge).deleted() && !mesh.is_boundary(edge)) inner.push_back(edge);
  }
  // Each turn shortens the sum of all edges, so this ends; the first passes do nearly all.
  constexpr int most_passes = 12;
  bool changed = true;
  for (int pass = 0; pass < most_passes && changed; ++pass) {
    changed = false;
    for (const auto edge : inner) changed |= shorten(mesh, edge, hull);
  }
}

}  // namespace rinkaku::silhouette
