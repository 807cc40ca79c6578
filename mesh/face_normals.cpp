#include "mesh/face_normals.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace rinkaku::mesh {
namespace {

/// A face without area and one of its neighbours.
struct Neighbour {
  double shared_sq = 0;  ///< squared length of the edge between them
  std::uint32_t from = 0;
  bool reversed = false;
  std::uint32_t to = 0;
};

std::vector<Neighbour> neighbours_of_degenerate(std::span<const glm::vec3> points, std::span<const HalfEdge> half_edges,
                                                const std::vector<std::uint8_t>& degenerate) {
  std::vector<Neighbour> found;
  for (std::size_t i = 0; i < half_edges.size();) {
    const auto edge = edge_at(half_edges, i);
    i += edge.size();
    // Chained in the edge's order, so that an edge of many faces stays cheap.
    for (std::size_t k = 0; k + 1 < edge.size(); ++k) {
      const HalfEdge& l = edge[k];
      const HalfEdge& r = edge[k + 1];
      const glm::dvec3 along = glm::dvec3(points[l.high]) - glm::dvec3(points[l.low]);
      const bool disagree = l.reversed == r.reversed;
      if (degenerate[l.face]) found.push_back({glm::dot(along, along), r.face, disagree, l.face});
      if (degenerate[r.face]) found.push_back({glm::dot(along, along), l.face, disagree, r.face});
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Neighbour& l, const Neighbour& r) { return l.shared_sq > r.shared_sq; });
  return found;
}

}  // namespace

bool FaceShape::degenerate() const {
  const double least = kLeastArea * longest_sq;
  return !(glm::dot(cross, cross) > least * least);
}

FaceShape face_shape(std::span<const glm::vec3> points, const glm::uvec3& face) {
  const glm::dvec3 a(points[face.x]);
  const glm::dvec3 ab = glm::dvec3(points[face.y]) - a;
  const glm::dvec3 ac = glm::dvec3(points[face.z]) - a;
  const glm::dvec3 bc = ac - ab;
  return {glm::cross(ab, ac), std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)})};
}

FaceNormals face_normals(std::span<const glm::vec3> points, std::span<const glm::uvec3> faces,
                         std::span<const HalfEdge> half_edges) {
  FaceNormals result;
  result.normal.resize(faces.size(), glm::dvec3(0));
  result.degenerate.resize(faces.size(), 0);
  bool any = false;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const FaceShape shape = face_shape(points, faces[f]);
    if (shape.degenerate()) {
      result.degenerate[f] = 1;
      any = true;
    } else {
      result.normal[f] = glm::normalize(shape.cross);
    }
  }
  if (!any) return result;

  std::vector<std::uint8_t> open = result.degenerate;
  const auto neighbours = neighbours_of_degenerate(points, half_edges, result.degenerate);
  // Normals spread one ring a round; strips of flat faces are short, so a few rounds do.
  constexpr int kRounds = 64;
  for (int round = 0; round < kRounds; ++round) {
    bool changed = false;
    const std::vector<std::uint8_t> before = open;
    for (const Neighbour& n : neighbours) {
      if (!open[n.to] || before[n.from]) continue;
      result.normal[n.to] = n.reversed ? -result.normal[n.from] : result.normal[n.from];
      open[n.to] = 0;
      changed = true;
    }
    if (!changed) break;
  }
  return result;
}

double corner_angle(std::span<const glm::vec3> points, const glm::uvec3& face, int corner) {
  const glm::dvec3 at(points[face[corner]]);
  const glm::dvec3 u = glm::dvec3(points[face[(corner + 1) % 3]]) - at;
  const glm::dvec3 v = glm::dvec3(points[face[(corner + 2) % 3]]) - at;
  return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
}

}  // namespace rinkaku::mesh
