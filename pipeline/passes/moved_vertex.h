#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "mesh/four.h"

namespace rinkaku::passes {

/// What of a ShapeVertex moves, for the attribute locations 0 to 2.
struct MovedVertex {
  glm::vec3 position{0};                         ///< in the object's coordinates
  std::array<std::int16_t, 4> normal{};          ///< snorm
  std::array<std::int16_t, 4> outline_normal{};  ///< snorm; the fourth is 0
};
static_assert(sizeof(MovedVertex) == 28 && offsetof(MovedVertex, normal) == 12);  // as skin.comp writes it

/// And what doesn't, for the locations 3 and 4.
struct VertexColour {
  glm::vec2 uv{0};
  std::array<std::uint8_t, 4> colour{};
};

/// Two vectors no longer than 1 as snorm() codes them: the same numbers, eight at once, not cut to -1 and 1.
inline void write_snorm(const mesh::Four& first, const mesh::Four& second, MovedVertex& to) {
  using Ints = std::int32_t __attribute__((vector_size(16)));
  using Shorts = std::int16_t __attribute__((vector_size(16)));
  const Ints a = __builtin_convertvector(first * 32767.0f + 32768.5f, Ints) - 32768;
  const Ints b = __builtin_convertvector(second * 32767.0f + 32768.5f, Ints) - 32768;
  // The lower halves of all eight.
  const auto codes =
      __builtin_shufflevector(std::bit_cast<Shorts>(a), std::bit_cast<Shorts>(b), 0, 2, 4, 6, 8, 10, 12, 14);
  std::memcpy(to.normal.data(), &codes, sizeof(codes));
}

/// Takes outline normals to what the vertices hold of them: unit vectors in the world, brought back to the object's
/// coordinates, so that uneven scales push at right angles to the surface as well, and times length_m(), so that the
/// longest is no longer than 1 however they turn.
class OutlinePush {
 public:
  explicit OutlinePush(const glm::dmat4& world_from_object);

  /// Metres in the world that a result of length 1 stands for.
  double length_m() const { return length_m_; }
  /// The object is scaled alike in all directions: what is pushed along are the outline normals themselves.
  bool evenly_scaled() const { return evenly_scaled_; }
  const glm::mat3& world_from_normal() const { return world_from_normal_; }
  const glm::mat3& object_from_world() const { return object_from_world_; }  ///< times length_m()

  mesh::Four operator()(const mesh::Four& outline_normal) const {
    if (evenly_scaled_) return outline_normal;
    const glm::vec3 outwards = world_from_normal_ * mesh::three(outline_normal);
    const float squared = glm::dot(outwards, outwards);
    return mesh::four(object_from_world_ * outwards * (squared > 0 ? 1.0f / std::sqrt(squared) : 0.0f));
  }

 private:
  double length_m_ = 1;
  bool evenly_scaled_ = false;
  glm::mat3 world_from_normal_, object_from_world_;
};

}  // namespace rinkaku::passes
