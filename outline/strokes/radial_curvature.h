#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "mesh/topology.h"
#include "outline/surroundings.h"

namespace rinkaku::outline {

/// How a surface bends in any direction, at each of its points. No GL.
///
/// The second fundamental form is fitted to the normal curvatures 2 n . (p - q) / |p - q|^2 towards the neighbours q of
/// a point p, by least squares, and averaged with the neighbours' a few times: smooth enough for the width of lines.
class RadialCurvature {
 public:
  /// Of the topology's own points. Keeps nothing of it. About a microsecond a point.
  explicit RadialCurvature(const mesh::Topology& topology);

  /// The surface has moved: what at() says of the wanted points is that of its points and unit normals as they are now,
  /// and of others what it was before. Points may be named several times. About a microsecond for each of them and of
  /// those around; allocates nothing once warm.
  void move(std::span<const glm::vec3> points, std::span<const glm::vec3> normals,
            std::span<const std::uint32_t> wanted);

  /// The normal curvature at a point in the direction in which an eye looks along the surface, 1 / length; positive on
  /// convex shapes. `to_eye` need not be of length 1.
  float at(std::uint32_t point, const glm::vec3& to_eye) const;

 private:
  void fit(std::span<const glm::vec3> points, std::span<const glm::vec3> normals);
  glm::mat3 fitted(std::span<const glm::vec3> points, const glm::vec3& normal, std::uint32_t point) const;

  Surroundings around_;
  std::vector<glm::vec3> normals_;
  std::vector<glm::mat3> forms_;  // v . (form v) for v in the tangent plane
  std::vector<glm::mat3> means_;
};

}  // namespace rinkaku::outline
