#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace rinkaku::mesh {

/// Four floats that are added and multiplied at once. Of a point or direction the fourth is 0.
using Four = float __attribute__((vector_size(16)));

inline Four four(const glm::vec3& v) { return Four{v.x, v.y, v.z, 0}; }
inline glm::vec3 three(const Four& f) { return {f[0], f[1], f[2]}; }
inline Four cross(const Four& a, const Four& b) {
  return __builtin_shufflevector(a, a, 1, 2, 0, 3) * __builtin_shufflevector(b, b, 2, 0, 1, 3) -
         __builtin_shufflevector(a, a, 2, 0, 1, 3) * __builtin_shufflevector(b, b, 1, 2, 0, 3);
}
inline float sum_of_three(const Four& f) { return f[0] + f[1] + f[2]; }

/// An affine map's columns: x, y, z, and where it takes the origin.
struct FourColumns {
  Four x{}, y{}, z{}, origin{};

  FourColumns() = default;
  explicit FourColumns(const glm::mat4& m)
      : x(four(glm::vec3(m[0]))), y(four(glm::vec3(m[1]))), z(four(glm::vec3(m[2]))), origin(four(glm::vec3(m[3]))) {}

  FourColumns operator*(float f) const {
    FourColumns out;
    out.x = x * f, out.y = y * f, out.z = z * f, out.origin = origin * f;
    return out;
  }
  FourColumns& operator+=(const FourColumns& o) {
    x += o.x, y += o.y, z += o.z, origin += o.origin;
    return *this;
  }
  /// Where a point goes. The shader that does the same adds in this order.
  Four at(const glm::vec3& p) const { return (x * p.x + y * p.y) + (z * p.z + origin); }
};

}  // namespace rinkaku::mesh
