#include "pipeline/frame/colour_matrix.h"

#include <utility>

namespace rinkaku {
namespace {

// Luma coefficients of red and blue, H.273 table 4.
std::pair<double, double> red_and_blue(int matrix) {
  switch (matrix) {
    case 1:
      return {0.2126, 0.0722};  // BT.709
    case 4:
      return {0.30, 0.11};  // FCC
    case 7:
      return {0.212, 0.087};  // SMPTE 240M
    case 9:
    case 10:
      return {0.2627, 0.0593};  // BT.2020
    default:
      return {0.299, 0.114};  // BT.601
  }
}

constexpr int ycgco = 8;

}  // namespace

int effective_matrix(const PictureFormat& format) {
  constexpr int unspecified = 2, reserved = 3, rgb = 0;
  const int matrix = format.colour.matrix;
  if (matrix != unspecified && matrix != reserved && !(matrix == rgb && format.pixels.model == ColourModel::Yuv)) {
    return matrix;
  }
  // As players guess; ffmpeg::assumed_matrix, by which sinks tag what they convert, says the same.
  return format.width_px >= 1280 || format.height_px > 576 ? 1 : 6;
}

bool is_full_range(const PictureFormat& format) {
  if (format.pixels.model == ColourModel::Rgb) return true;
  if (format.colour.range != ColourTags::Range::Unspecified) return format.colour.range == ColourTags::Range::Full;
  return format.pixels.model == ColourModel::Grey;
}

std::array<ComponentWeights, 4> component_weights(const PictureFormat& format) {
  const PixelFormat& pixels = format.pixels;
  std::array<ComponentWeights, 4> weights{};
  auto code_values = [&](int component) { return static_cast<double>(1 << pixels.component[component].depth_bits); };
  auto set = [](double r, double g, double b, double a) {
    return ComponentWeights{static_cast<float>(r), static_cast<float>(g), static_cast<float>(b), static_cast<float>(a)};
  };
  if (pixels.has_alpha) {
    const int last = pixels.components - 1;
    weights[last] = set(0, 0, 0, (code_values(last) - 1) / 255);
  }
  if (pixels.model == ColourModel::Rgb) {
    for (int c = 0; c < 3; ++c) {
      const double scale = (code_values(c) - 1) / 255;
      weights[c] = set(c == 0 ? scale : 0, c == 1 ? scale : 0, c == 2 ? scale : 0, 0);
    }
    return weights;
  }
  const int matrix = effective_matrix(format);
  const bool full = is_full_range(format);
  auto [kr, kb] = red_and_blue(matrix);
  if (matrix == ycgco) kr = kb = 0.25;
  const double kg = 1 - kr - kb;
  {
    const double values = code_values(0);
    const double range = full ? values - 1 : 219 * values / 256, offset = full ? 0 : 16 * values / 256;
    weights[0] = set(range * kr / 255, range * kg / 255, range * kb / 255, offset / 255);
  }
  if (pixels.model == ColourModel::Grey) return weights;
  for (int c = 1; c < 3; ++c) {
    const double values = code_values(c);
    const double range = (full ? values - 1 : 224 * values / 256) / 255, offset = values / 2 / 255;
    double r, g, b;
    if (matrix == ycgco) {
      r = c == 1 ? -0.25 : 0.5, g = c == 1 ? 0.5 : 0, b = c == 1 ? -0.25 : -0.5;
    } else if (c == 1) {
      r = -kr / (2 * (1 - kb)), g = -kg / (2 * (1 - kb)), b = 0.5;
    } else {
      r = 0.5, g = -kg / (2 * (1 - kr)), b = -kb / (2 * (1 - kr));
    }
    weights[c] = set(range * r, range * g, range * b, offset);
  }
  return weights;
}

}  // namespace rinkaku
