#pragma once

#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "water/surface.h"

namespace rinkaku::water {

/// Something that stands in the water: triangles in the world.
struct Solid {
  std::vector<glm::vec3> positions_m;
  std::vector<glm::uvec3> triangles;
};

/// A piece of the line in which a solid's skin meets the water, in the surface's metres.
struct Segment {
  glm::dvec2 a{0}, b{0};
};

/// The line in which a solid cuts a surface, as far as it lies in the water: one segment for each triangle that the
/// plane passes through. Cost: one look at each vertex and triangle.
std::vector<Segment> section(const Solid& solid, const Surface& surface);

}  // namespace rinkaku::water
