#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace rinkaku {

/// A rotation followed by a translation, in double. Named by what it maps: `camera_from_world` takes world points to
/// the camera's frame, and transforms read right to left: camera_from_world * world_from_object.
struct RigidTransform {
  glm::dquat rotation{1, 0, 0, 0};  ///< unit length; (w, x, y, z)
  glm::dvec3 translation_m{0, 0, 0};

  glm::dvec3 operator*(const glm::dvec3& point) const { return rotation * point + translation_m; }
  RigidTransform operator*(const RigidTransform& b) const {
    return {glm::normalize(rotation * b.rotation), rotation * b.translation_m + translation_m};
  }
};

inline RigidTransform inverse(const RigidTransform& t) {
  const glm::dquat back = glm::conjugate(t.rotation);
  return {back, -(back * t.translation_m)};
}

inline glm::dmat4 to_matrix(const RigidTransform& t) {
  glm::dmat4 m = glm::mat4_cast(t.rotation);
  m[3] = glm::dvec4(t.translation_m, 1.0);
  return m;
}

}  // namespace rinkaku
