#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace rinkaku::passes {

/// Surfaces are drawn smaller by this at the contour, and by less where they don't stand on edge: see pushed() in
/// screen_offset.glsl. A feather reaches as far outwards.
inline constexpr float feather_px = 0.5f;

/// A vertex as the passes' shaders read it, at the attribute locations 0 to 4.
struct ShapeVertex {
  glm::vec3 position{0};                         ///< in the object's coordinates
  std::array<std::int16_t, 4> normal{};          ///< snorm; for shading
  std::array<std::int16_t, 4> outline_normal{};  ///< snorm; the fourth is 1 at the rim of a contour strip, else 0
  glm::vec2 uv{0};
  std::array<std::uint8_t, 4> colour{};  ///< unorm, sRGB-encoded
};

/// Numbers from -1 to 1 as the vertices hold them; the fourth is 0.
std::array<std::int16_t, 4> snorm(const glm::dvec3& v);
/// The same, cheaply, for what is done each frame: no call to round, as all is above 0 before it is cut.
inline std::array<std::int16_t, 4> snorm(const glm::vec3& v) {
  const auto code = [](float f) {
    return static_cast<std::int16_t>(static_cast<int>(std::clamp(f, -1.0f, 1.0f) * 32767.0f + 32768.5f) - 32768);
  };
  return {code(v.x), code(v.y), code(v.z), 0};
}
/// Numbers from 0 to 1 likewise.
std::array<std::uint8_t, 4> unorm(const glm::vec4& v);

/// A vertex of a strip that lies on a surface, at the locations 0 to 5.
struct BorderVertex {
  ShapeVertex shape;  ///< of the part whose colour the strip has
  /// snorm; the direction in which the rim is moved, in the object's coordinates, and by how many pixels. That is also
  /// the coverage at the edge.
  std::array<std::int16_t, 4> across{};
};

/// Triangles of one part of the mesh within an index list.
struct Run {
  std::uint32_t part = 0;
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  bool even = false;  ///< no triangle's colour changes over it
};

/// Adds the two triangles of a strip's quad: the vertices from `first` on are two on the edge and the same two at the
/// rim. Opens a run where the last one is another part's.
void append_quad(std::uint32_t part, std::uint32_t first, std::vector<std::uint32_t>& indices, std::vector<Run>& runs);

}  // namespace rinkaku::passes
