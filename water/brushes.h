#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "water/reference_picture.h"

namespace rinkaku::water {

/// Brush textures of one size, one after another; the stroke runs along x. Two bytes a texel: how much paint there is,
/// and how light it is (128: the stroke's own colour).
struct BrushSheet {
  int width_px = 128, height_px = 32;
  int layers = 0;
  std::vector<std::uint8_t> texels;
};

/// How many brushes of each density line_brushes() makes, and how many densities.
inline constexpr int brush_variants = 4, brush_densities = 4;

/// Brushes made of lines along the stroke, each with its own width, paint and ends, as a brush's hairs leave them.
/// Layer = density * brush_variants + variant; density 0 is sparse, for changing flow, with gaps between the lines
/// that show what lies below; the last one is dense, for calm water. (Suzuki et al. 2004, 5.1 a.)
BrushSheet line_brushes();

/// The user's own brushes, a layer each, from pictures of any size: as much paint as the picture is light (and opaque,
/// if it has four channels). (Suzuki et al. 2004, 2.3.)
BrushSheet own_brushes(std::span<const Picture> pictures);

/// How brushes at places are blended elsewhere: shares in inverse proportion to the distance, that add up to 255.
/// At most four. (Suzuki et al. 2004, 5.1 b.)
std::array<std::uint8_t, 4> brush_shares(std::span<const glm::dvec2> places, glm::dvec2 at);

/// A brush of blobs, for spray.
BrushSheet drop_brushes();

}  // namespace rinkaku::water
