#pragma once

#include <cstdint>
#include <vector>

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

/// A brush of blobs, for spray.
BrushSheet drop_brushes();

}  // namespace rinkaku::water
