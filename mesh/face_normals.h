#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "mesh/half_edges.h"

namespace rinkaku::mesh {

/// How flat a triangle may be and still have area: twice its area over its longest edge squared. Far above what
/// rounding makes of three points in one line, far below any triangle somebody meant.
inline constexpr double kLeastArea = 1e-12;

/// The three points of a face in double, and what is measured on them.
struct FaceShape {
  glm::dvec3 cross{0};    ///< normal times twice the area
  double longest_sq = 0;  ///< squared length of the longest edge
  bool degenerate() const;
};
FaceShape face_shape(std::span<const glm::vec3> points, const glm::uvec3& face);

struct FaceNormals {
  std::vector<glm::dvec3> normal;        ///< unit; zero only where a whole component has no area
  std::vector<std::uint8_t> degenerate;  ///< 1: no area of its own, so it has a neighbour's normal
};

/// Normals of all faces. A face without area takes the normal of the neighbour across its longest possible edge
/// (reversed where their windings disagree), so that nothing is read out of rounding noise.
FaceNormals face_normals(std::span<const glm::vec3> points, std::span<const glm::uvec3> faces,
                         std::span<const HalfEdge> half_edges);

/// The face's angle at one corner, in radians; 0 for a face without area.
double corner_angle(std::span<const glm::vec3> points, const glm::uvec3& face, int corner);

}  // namespace rinkaku::mesh
