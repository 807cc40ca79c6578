#include "silhouette/verify/hull_faces.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace rinkaku::silhouette {
namespace {

// The plane through three homogeneous points: orthogonal to all of them.
glm::dvec4 plane_through(const glm::dvec4& a, const glm::dvec4& b, const glm::dvec4& c) {
  const auto without = [&](int row) {
    glm::dmat3 m;
    int to = 0;
    for (int from = 0; from < 4; ++from) {
      if (from != row) m[to++] = {a[from], b[from], c[from]};
    }
    return glm::determinant(m);
  };
  return {without(0), -without(1), without(2), -without(3)};
}

}  // namespace

HullFaces hull_faces(const ViewRegion& region) {
  const auto& hull = region.hull;
  const auto count = static_cast<std::uint32_t>(hull.size());
  std::set<std::vector<std::uint32_t>> faces;
  for (std::uint32_t i = 0; i < count; ++i) {
    for (std::uint32_t j = i + 1; j < count; ++j) {
      for (std::uint32_t k = j + 1; k < count; ++k) {
        const glm::dvec4 plane = plane_through(hull[i], hull[j], hull[k]);
        double before = 0, behind = 0;
        for (const glm::dvec4& vertex : hull) {
          before = std::max(before, glm::dot(plane, vertex));
          behind = std::max(behind, -glm::dot(plane, vertex));
        }
        const double in_plane = 1e-9 * std::max(before, behind);
        if (in_plane == 0 || std::min(before, behind) > in_plane) continue;
        std::vector<std::uint32_t> face;
        for (std::uint32_t v = 0; v < count; ++v) {
          if (std::abs(glm::dot(plane, hull[v])) <= in_plane) face.push_back(v);
        }
        faces.insert(std::move(face));
      }
    }
  }
  HullFaces out;
  out.faces.assign(faces.begin(), faces.end());
  const auto shared = [&](std::uint32_t a, std::uint32_t b) {
    return std::count_if(out.faces.begin(), out.faces.end(), [&](const auto& face) {
      return std::binary_search(face.begin(), face.end(), a) && std::binary_search(face.begin(), face.end(), b);
    });
  };
  for (std::uint32_t a = 0; a < count; ++a) {
    for (std::uint32_t b = a + 1; b < count; ++b) {
      if (shared(a, b) >= 2) out.edges.push_back({a, b});
    }
  }
  return out;
}

}  // namespace rinkaku::silhouette
