#pragma once

#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace rinkaku::water {

/// Cuts a counter-clockwise polygon with clockwise holes into triangles, three points each, by cutting off ears; holes
/// are first joined to the outline by bridges. The polygon must not cross itself. Cost: quadratic in the corners.
std::vector<glm::dvec2> triangulate(std::span<const glm::dvec2> outline,
                                    std::span<const std::vector<glm::dvec2>> holes);

/// Twice the signed area of a triangle: positive if counter-clockwise.
inline double cross(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Positive if counter-clockwise.
double signed_area(std::span<const glm::dvec2> ring);

/// Whether two segments have a point in common that is an end of neither.
bool segments_cross(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d);

}  // namespace rinkaku::water
