#include "mesh/moved_faces.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "mesh/four.h"

namespace rinkaku::mesh {
namespace {

// Of four faces at once.
struct Vectors {
  Four x, y, z;
};

Vectors operator-(const Vectors& a, const Vectors& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Four dot(const Vectors& a, const Vectors& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Four larger(const Four& a, const Four& b) { return a > b ? a : b; }

// The x and y of two points, in a row.
Four pairs(const glm::vec3& a, const glm::vec3& b) {
  using Eights = double __attribute__((vector_size(16)));
  std::array<double, 2> halves;
  std::memcpy(&halves[0], &a, 8);
  std::memcpy(&halves[1], &b, 8);
  return std::bit_cast<Four>(Eights{halves[0], halves[1]});
}

Vectors corners(const std::array<const glm::uvec3*, 4>& faces, int corner, std::span<const glm::vec3> points) {
  const glm::vec3 &a = points[(*faces[0])[corner]], &b = points[(*faces[1])[corner]];
  const glm::vec3 &c = points[(*faces[2])[corner]], &d = points[(*faces[3])[corner]];
  const Four ab = pairs(a, b), cd = pairs(c, d);
  return {__builtin_shufflevector(ab, cd, 0, 2, 4, 6), __builtin_shufflevector(ab, cd, 1, 3, 5, 7),
          Four{a.z, b.z, c.z, d.z}};
}

Four roots(const Four& f) { return Four{std::sqrt(f[0]), std::sqrt(f[1]), std::sqrt(f[2]), std::sqrt(f[3])}; }

}  // namespace

void classify_moved(std::span<const glm::uvec3> faces, std::span<const glm::vec3> points, const glm::vec3& origin,
                    const Eye& eye, std::span<const std::uint8_t> two_sided, std::span<std::uint8_t> front,
                    std::span<std::uint8_t> seen_front, std::vector<std::uint32_t>& flat) {
  constexpr float least_squared = 1e-12f;  // of the longest edge's fourth power: below, directions are rounding
  using Bytes = std::int8_t __attribute__((vector_size(4)));
  for (std::size_t f = 0; f < faces.size(); f += 4) {
    const std::size_t count = std::min<std::size_t>(4, faces.size() - f);
    // The last ones again, where there are no four.
    std::array<const glm::uvec3*, 4> four_faces;
    for (std::size_t k = 0; k < 4; ++k) four_faces[k] = &faces[f + std::min(k, count - 1)];
    const Vectors corner = corners(four_faces, 0, points);
    const Vectors u = corners(four_faces, 1, points) - corner, v = corners(four_faces, 2, points) - corner, w = v - u;
    const Vectors cross{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
    const Vectors towards{eye.x - (corner.x - origin.x) * eye.w, eye.y - (corner.y - origin.y) * eye.w,
                          eye.z - (corner.z - origin.z) * eye.w};
    const Four squared = dot(cross, cross), distance = dot(cross, towards);
    const Four longest = larger(larger(dot(u, u), dot(v, v)), dot(w, w));
    const auto clear = __builtin_convertvector(squared > least_squared * longest * longest, Bytes);
    const auto is_front = __builtin_convertvector(distance > 0.0f, Bytes) & 1;
    const auto is_seen = __builtin_convertvector(distance > -eye.margin * roots(squared), Bytes) & 1;
    Bytes sides{};
    std::memcpy(&sides, &two_sided[f], count);
    const Bytes shown = is_seen | sides;
    std::memcpy(&front[f], &is_front, count);
    std::memcpy(&seen_front[f], &shown, count);
    for (std::size_t k = 0; k < count; ++k) {
      if (clear[k] == 0) [[unlikely]]
        flat.push_back(static_cast<std::uint32_t>(f + k));
    }
  }
}

}  // namespace rinkaku::mesh
