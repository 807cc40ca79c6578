#pragma once

#include <span>

#include <glm/vec3.hpp>

namespace rinkaku::mesh {

/// An axis-aligned box; empty (min above max) if no point was given.
struct Box {
  glm::vec3 min{1, 1, 1};
  glm::vec3 max{-1, -1, -1};
  bool empty() const { return min.x > max.x; }
  glm::dvec3 centre() const { return (glm::dvec3(min) + glm::dvec3(max)) * 0.5; }
  glm::dvec3 size() const { return empty() ? glm::dvec3(0) : glm::dvec3(max) - glm::dvec3(min); }
};

struct Sphere {
  glm::dvec3 centre{0};
  double radius = 0;
};

Box bounding_box(std::span<const glm::vec3> positions);

/// The least sphere around the bounding box's centre that holds every position.
Sphere bounding_sphere(std::span<const glm::vec3> positions);

}  // namespace rinkaku::mesh
