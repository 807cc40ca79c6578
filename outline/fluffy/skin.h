#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace rinkaku::fluffy {

/// A face of the skin that fluff grows on.
struct SkinFace {
  glm::uvec3 corners{0};  ///< points
  bool inwards = false;   ///< its corners run clockwise seen from outside
};

/// The mean of the faces' normals at each point, weighted by the faces' angle there; a point none of whose faces has
/// area keeps the normal that is in `normals` already. Allocates nothing. About 0.1 microseconds a face.
void find_normals(std::span<const glm::dvec3> points, std::span<const SkinFace> faces, std::span<glm::dvec3> normals);

struct SkinCentre {
  glm::dvec3 place{0};       ///< of gravity of the faces' area
  double mean_radius_m = 0;  ///< of that area, from there
};

/// Precondition: `faces` isn't empty.
SkinCentre find_centre(std::span<const glm::dvec3> points, std::span<const glm::uvec3> faces);

}  // namespace rinkaku::fluffy
