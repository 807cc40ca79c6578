#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pipeline/frame/pixel_rect.h"

namespace rinkaku {

/// How much of each pixel of a frame a filmed thing covers, and how far away the thing is.
///
/// Pixels are the plate's (with its lens distortion), rows from the top without gaps, the whole picture.
struct Matte {
  std::int64_t frame_number = -1;  ///< the frame that it was found in
  int thing = 0;                   ///< which of the scene's things, from 0
  int width_px = 0;
  int height_px = 0;
  PixelRect rect;                   ///< alpha is 0 outside
  std::vector<std::uint8_t> alpha;  ///< 0 nothing, 255 wholly covered
  /// RGB, 3 bytes a pixel: the thing's own colour, free of what is behind it, where alpha is neither 0 nor 255;
  /// meaningless elsewhere.
  std::vector<std::uint8_t> own_rgb;
  double distance_m = 0;  ///< along the camera's axis

  /// A line around the thing, just behind it: how much of each pixel of line_rect it covers; empty if there is none.
  PixelRect line_rect;
  std::vector<std::uint8_t> line;
  std::array<std::uint8_t, 3> line_rgb{};

  const std::uint8_t* alpha_row(int y_px) const { return alpha.data() + static_cast<std::size_t>(y_px) * width_px; }
  std::uint8_t* alpha_row(int y_px) { return alpha.data() + static_cast<std::size_t>(y_px) * width_px; }
};

}  // namespace rinkaku
