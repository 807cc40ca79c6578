#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace rinkaku::water {

/// A stroke on the screen, as the pass draws it: a brush's picture along a line. Pixels of the pinhole picture.
struct Stroke {
  glm::vec2 middle_px{0};
  glm::vec2 half_px{0};  ///< from the middle to the stroke's end
  float half_width_px = 0;
  float brush = 0;  ///< layer of the brush sheet
  float depth_m = 1;
  std::array<std::uint8_t, 4> blend{};   ///< of the user's own brushes: shares that add up to 255
  std::array<std::uint8_t, 4> colour{};  ///< sRGB-coded, and opacity
};

/// Strokes in the order in which they are painted.
using Strokes = std::vector<Stroke>;

}  // namespace rinkaku::water
