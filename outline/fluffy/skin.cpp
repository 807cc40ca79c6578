#include "outline/fluffy/skin.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace rinkaku::fluffy {
namespace {

// What `value` is on average over the faces' area, as found at their middles.
template <typename Value>
auto mean_over(std::span<const glm::dvec3> points, std::span<const glm::uvec3> faces, Value value) {
  decltype(value(glm::dvec3())) sum(0);
  double area = 0;
  for (const glm::uvec3& face : faces) {
    const glm::dvec3 a = points[face.x], b = points[face.y], c = points[face.z];
    const double twice_area = glm::length(glm::cross(b - a, c - a));
    sum += value((a + b + c) / 3.0) * twice_area;
    area += twice_area;
  }
  return area > 0 ? sum / area : value(points[faces.front().x]);
}

}  // namespace

void find_normals(std::span<const glm::dvec3> points, std::span<const SkinFace> faces, std::span<glm::dvec3> normals) {
  // Sums start at what a point keeps if nothing is added, made too short to count beside an angle.
  constexpr double nothing = 1e-30;
  for (glm::dvec3& n : normals) n *= nothing;
  for (const SkinFace& face : faces) {
    const glm::uvec3& corners = face.corners;
    const glm::dvec3 a = points[corners.x], b = points[corners.y], c = points[corners.z];
    const glm::dvec3 cross = glm::cross(b - a, c - a);
    const double twice_area = glm::length(cross);
    if (!(twice_area > 0)) continue;
    const glm::dvec3 normal = cross * ((face.inwards ? -1.0 : 1.0) / twice_area);
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 at = points[corners[k]];
      const glm::dvec3 one = points[corners[(k + 1) % 3]] - at, other = points[corners[(k + 2) % 3]] - at;
      // The angle by its sine, which is the area's, and its cosine.
      normals[corners[k]] += normal * std::atan2(twice_area, glm::dot(one, other));
    }
  }
  for (glm::dvec3& n : normals) n = glm::normalize(n);
}

SkinCentre find_centre(std::span<const glm::dvec3> points, std::span<const glm::uvec3> faces) {
  SkinCentre centre;
  centre.place = mean_over(points, faces, [](const glm::dvec3& p) { return p; });
  centre.mean_radius_m = mean_over(points, faces, [&](const glm::dvec3& p) { return glm::length(p - centre.place); });
  return centre;
}

}  // namespace rinkaku::fluffy
