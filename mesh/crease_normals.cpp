#include "mesh/crease_normals.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <glm/geometric.hpp>

#include "mesh/face_normals.h"
#include "mesh/half_edges.h"

namespace rinkaku::mesh {
namespace {

/// Corners that share a normal, up to its sign: a union-find forest with the sign to the parent.
class CornerGroups {
 public:
  explicit CornerGroups(std::size_t corners) : parent_(corners), flipped_(corners, 0) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  struct Root {
    std::uint32_t corner;
    bool flipped;
  };
  Root find(std::uint32_t corner) {
    bool flipped = false;
    std::uint32_t at = corner;
    while (parent_[at] != at) {
      // Halve the path: skip to the grandparent, whose sign is the product of both steps.
      const std::uint32_t up = parent_[at];
      flipped_[at] = flipped_[at] ^ flipped_[up];
      parent_[at] = parent_[up];
      flipped = flipped != (flipped_[at] != 0);
      at = parent_[at];
    }
    return {at, flipped};
  }
  void join(std::uint32_t l, std::uint32_t r, bool opposite) {
    const Root a = find(l);
    const Root b = find(r);
    if (a.corner == b.corner) return;
    const std::uint32_t low = std::min(a.corner, b.corner);
    const std::uint32_t high = std::max(a.corner, b.corner);
    parent_[high] = low;
    flipped_[high] = (a.flipped != b.flipped) != opposite;
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint8_t> flipped_;
};

/// The corner of a half-edge's face at the edge's lower or higher point.
std::uint32_t corner_at(const HalfEdge& half_edge, bool high) {
  const int corner = half_edge.reversed == high ? half_edge.corner : (half_edge.corner + 1) % 3;
  return half_edge.face * 3 + static_cast<std::uint32_t>(corner);
}

/// More faces than this at one edge are not a surface any more; such an edge is hard.
constexpr std::size_t kMostFaces = 16;

}  // namespace

std::vector<glm::vec3> crease_normals(std::span<const glm::vec3> points, std::span<const glm::uvec3> faces,
                                      double crease_deg) {
  const auto half_edges = half_edges_by_edge(faces, static_cast<std::uint32_t>(points.size()));
  const FaceNormals of_face = face_normals(points, faces, half_edges);
  // A hair of slack, so that a bend of exactly the crease angle is smooth whatever the rounding.
  const double least_cos = std::cos(std::clamp(crease_deg, 0.0, 180.0) * std::numbers::pi / 180.0) - 1e-9;

  CornerGroups groups(faces.size() * 3);
  const auto join_if_smooth = [&](const HalfEdge& l, const HalfEdge& r) {
    const bool opposite = l.reversed == r.reversed;
    const double cosine = glm::dot(of_face.normal[l.face], of_face.normal[r.face]);
    if ((opposite ? -cosine : cosine) < least_cos) return;
    groups.join(corner_at(l, false), corner_at(r, false), opposite);
    groups.join(corner_at(l, true), corner_at(r, true), opposite);
  };
  for (std::size_t i = 0; i < half_edges.size();) {
    const auto edge = edge_at(half_edges, i);
    i += edge.size();
    if (edge.size() == 2) {
      join_if_smooth(edge[0], edge[1]);
    } else if (edge.size() <= kMostFaces) {
      for (std::size_t l = 0; l < edge.size(); ++l) {
        for (std::size_t r = l + 1; r < edge.size(); ++r) {
          if (edge[l].reversed != edge[r].reversed) join_if_smooth(edge[l], edge[r]);
        }
      }
    }
  }

  std::vector<glm::dvec3> sum(faces.size() * 3, glm::dvec3(0));
  for (std::uint32_t face = 0; face < faces.size(); ++face) {
    if (of_face.degenerate[face]) continue;
    for (int c = 0; c < 3; ++c) {
      const auto root = groups.find(face * 3 + static_cast<std::uint32_t>(c));
      const double weight = corner_angle(points, faces[face], c);
      sum[root.corner] += of_face.normal[face] * (root.flipped ? -weight : weight);
    }
  }
  std::vector<glm::vec3> normals(faces.size() * 3);
  for (std::uint32_t corner = 0; corner < normals.size(); ++corner) {
    const auto root = groups.find(corner);
    const glm::dvec3 mean = root.flipped ? -sum[root.corner] : sum[root.corner];
    const double length = glm::length(mean);
    const glm::dvec3 own = of_face.normal[corner / 3];
    if (length > 1e-9) {
      normals[corner] = glm::vec3(mean / length);
    } else {
      normals[corner] = own == glm::dvec3(0) ? glm::vec3(0, 0, 1) : glm::vec3(own);
    }
  }
  return normals;
}

}  // namespace rinkaku::mesh
