#include "silhouette/nearest_in_simplex.h"

#include <algorithm>
#include <limits>

#include <glm/geometric.hpp>

namespace rinkaku::silhouette {
namespace {

glm::dvec3 nearest_in_segment(Simplex& s) {
  const glm::dvec3 along = s.points[1] - s.points[0];
  const double length_sq = glm::dot(along, along);
  const double t = length_sq > 0 ? -glm::dot(s.points[0], along) / length_sq : 0.0;
  if (t <= 0) {
    s.size = 1;
    return s.points[0];
  }
  if (t >= 1) {
    s.points[0] = s.points[1];
    s.size = 1;
    return s.points[0];
  }
  return s.points[0] + along * t;
}

/// The nearest of the simplex's sides, each with one point less.
glm::dvec3 nearest_in_sides(Simplex& s) {
  Simplex best;
  glm::dvec3 nearest(0);
  double least_sq = std::numeric_limits<double>::infinity();
  for (int without = 0; without < s.size; ++without) {
    Simplex side;
    for (int i = 0; i < s.size; ++i) {
      if (i != without) side.points[side.size++] = s.points[i];
    }
    const glm::dvec3 point = nearest_in_simplex(side);
    if (glm::dot(point, point) < least_sq) {
      least_sq = glm::dot(point, point);
      nearest = point;
      best = side;
    }
  }
  s = best;
  return nearest;
}

glm::dvec3 nearest_in_triangle(Simplex& s) {
  const auto& p = s.points;
  const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
  const double normal_sq = glm::dot(normal, normal);
  const auto inner_side = [&](int a, int b) { return glm::dot(glm::cross(p[b] - p[a], -p[a]), normal) >= 0; };
  if (normal_sq > 0 && inner_side(0, 1) && inner_side(1, 2) && inner_side(2, 0)) {
    return normal * (glm::dot(normal, p[0]) / normal_sq);
  }
  return nearest_in_sides(s);
}

glm::dvec3 nearest_in_tetrahedron(Simplex& s) {
  const auto& p = s.points;
  // Inside, if the origin is on the same side of each face as the point across it.
  const auto same_side = [&](int a, int b, int c, int across) {
    const glm::dvec3 normal = glm::cross(p[b] - p[a], p[c] - p[a]);
    const double there = glm::dot(normal, p[across] - p[a]);
    return there * -glm::dot(normal, p[a]) >= 0 && there != 0;
  };
  if (same_side(0, 1, 2, 3) && same_side(1, 2, 3, 0) && same_side(2, 3, 0, 1) && same_side(3, 0, 1, 2)) {
    return glm::dvec3(0);
  }
  return nearest_in_sides(s);
}

}  // namespace

glm::dvec3 nearest_in_simplex(Simplex& simplex) {
  switch (simplex.size) {
    case 1:
      return simplex.points[0];
    case 2:
      return nearest_in_segment(simplex);
    case 3:
      return nearest_in_triangle(simplex);
    default:
      return nearest_in_tetrahedron(simplex);
  }
}

}  // namespace rinkaku::silhouette
