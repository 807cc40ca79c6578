#include "mesh/bounds.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace rinkaku::mesh {

Box bounding_box(std::span<const glm::vec3> positions) {
  Box box;
  if (positions.empty()) return box;
  box.min = box.max = positions.front();
  for (const glm::vec3& p : positions) {
    box.min = glm::min(box.min, p);
    box.max = glm::max(box.max, p);
  }
  return box;
}

Sphere bounding_sphere(std::span<const glm::vec3> positions) {
  if (positions.empty()) return {};
  const glm::dvec3 centre = bounding_box(positions).centre();
  double radius_sq = 0;
  for (const glm::vec3& p : positions) {
    const glm::dvec3 away = glm::dvec3(p) - centre;
    radius_sq = std::max(radius_sq, glm::dot(away, away));
  }
  return {centre, std::sqrt(radius_sq)};
}

}  // namespace rinkaku::mesh
