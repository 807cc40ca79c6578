#include "pipeline/passes/composite/straight_alpha.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace rinkaku::passes {

PictureFormat rgba_format(int width_px, int height_px, Rational sample_aspect) {
  PictureFormat format;
  format.width_px = width_px;
  format.height_px = height_px;
  format.sample_aspect = sample_aspect;
  format.pixels.name = "rgba";
  format.pixels.model = ColourModel::Rgb;
  format.pixels.planes = 1;
  format.pixels.components = 4;
  format.pixels.has_alpha = true;
  for (int c = 0; c < 4; ++c) format.pixels.component[c] = {0, 4, c, 0, 8};
  constexpr int rgb_matrix = 0, srgb_primaries = 1, srgb_transfer = 13;
  format.colour = {srgb_primaries, srgb_transfer, rgb_matrix, ColourTags::Range::Full, 0};
  return format;
}

void to_straight_alpha(const Layer& layer, double opacity, Frame& frame) {
  const Plane& plane = frame.planes[0];
  for (int y = 0; y < plane.rows; ++y) {
    std::memset(plane.data + y * plane.stride_bytes, 0, static_cast<std::size_t>(plane.row_bytes));
  }
  const int fade = static_cast<int>(std::lround(std::clamp(opacity, 0.0, 1.0) * 256));
  for (int y = 0; y < layer.rect.height_px; ++y) {
    const std::uint8_t* in = layer.rgba.data() + static_cast<std::size_t>(y) * layer.rect.width_px * 4;
    std::uint8_t* out = plane.data + (layer.rect.y_px + y) * plane.stride_bytes + layer.rect.x_px * 4;
    for (int x = 0; x < layer.rect.width_px; ++x, in += 4, out += 4) {
      const int alpha = in[3];
      if (alpha == 0) continue;
      for (int c = 0; c < 3; ++c) out[c] = static_cast<std::uint8_t>(std::min(255, (in[c] * 255 + alpha / 2) / alpha));
      out[3] = static_cast<std::uint8_t>((alpha * fade + 128) >> 8);
    }
  }
}

}  // namespace rinkaku::passes
