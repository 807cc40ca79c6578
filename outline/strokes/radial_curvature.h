#pragma once

#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "mesh/topology.h"

namespace rinkaku::outline {

/// How a surface bends in any direction, at each of its points. No GL.
///
/// The second fundamental form is fitted to the normal curvatures 2 n . (p - q) / |p - q|^2 towards the neighbours q of
/// a point p, by least squares, and averaged with the neighbours' a few times: smooth enough for the width of lines.
class RadialCurvature {
 public:
  /// Keeps nothing of the topology. About a microsecond a point.
  explicit RadialCurvature(const mesh::Topology& topology);

  /// The normal curvature at a point in the direction in which an eye looks along the surface, 1 / length; positive on
  /// convex shapes. `to_eye` need not be of length 1.
  float at(std::uint32_t point, const glm::vec3& to_eye) const;

 private:
  std::vector<glm::vec3> normals_;
  std::vector<glm::mat3> forms_;  // v . (form v) for v in the tangent plane
};

}  // namespace rinkaku::outline
