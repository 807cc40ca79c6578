#pragma once

#include <array>

#include <glm/vec3.hpp>

namespace rinkaku::silhouette {

/// Up to four points, of whose hull the point nearest to the origin is looked for.
struct Simplex {
  std::array<glm::dvec3, 4> points;
  int size = 0;
};

/// The hull's point nearest to the origin; keeps only the points that it lies between. Zero if the origin is inside.
glm::dvec3 nearest_in_simplex(Simplex& simplex);

}  // namespace rinkaku::silhouette
