#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace rinkaku {

/// A ratio of integers, as containers store time bases, rates and aspects. `den` is never 0.
struct Rational {
  std::int64_t num = 0;
  std::int64_t den = 1;
  bool operator==(const Rational&) const = default;
  double value() const { return static_cast<double>(num) / static_cast<double>(den); }
};

/// Where one component (Y, U, V, R, G, B or A) lies in memory.
///
/// The sample at (x, y) of the component's own grid is the integer of `depth_bits` bits at
/// plane `plane`, byte y * stride + x * step_bytes + offset_bytes, shifted right by `shift_bits`.
/// Samples of more than 8 bits (depth_bits + shift_bits > 8) take two bytes.
struct Component {
  int plane = 0;
  int step_bytes = 1;
  int offset_bytes = 0;
  int shift_bits = 0;
  int depth_bits = 8;
  bool operator==(const Component&) const = default;
};

enum class ColourModel { Grey, Yuv, Rgb };

/// The memory layout of a picture's samples. Component order: Y [U V] [A], or R G B [A].
struct PixelFormat {
  std::string name;  ///< FFmpeg's name, e.g. "yuv420p10le"
  ColourModel model = ColourModel::Yuv;
  int planes = 3;
  int components = 3;         ///< alpha included
  bool has_alpha = false;     ///< straight, always the last component
  bool big_endian = false;    ///< for samples of two bytes
  int log2_chroma_width = 0;  ///< the chroma grid's width is ceil(width / 2^this); 0 for Grey and Rgb
  int log2_chroma_height = 0;
  std::array<Component, 4> component{};
  bool operator==(const PixelFormat&) const = default;
};

/// 8-bit grey in one plane.
inline PixelFormat grey8() {
  PixelFormat pixels;
  pixels.name = "gray";
  pixels.model = ColourModel::Grey;
  pixels.planes = pixels.components = 1;
  return pixels;
}

/// 16-bit grey in one plane, high bytes first as PNG has them.
inline PixelFormat grey16be() {
  PixelFormat pixels = grey8();
  pixels.name = "gray16be";
  pixels.big_endian = true;
  pixels.component[0].step_bytes = 2;
  pixels.component[0].depth_bits = 16;
  return pixels;
}

/// Colour description: code points of ITU-T H.273 (the numbers that containers and FFmpeg use), 2 is unspecified.
struct ColourTags {
  enum class Range { Unspecified, Limited, Full };
  int primaries = 2;
  int transfer = 2;
  int matrix = 2;
  Range range = Range::Unspecified;
  int chroma_location = 0;  ///< 0 unspecified, else H.273's chroma sample location type + 1
  bool operator==(const ColourTags&) const = default;
};

/// Everything that stays the same from frame to frame.
struct PictureFormat {
  int width_px = 0;
  int height_px = 0;
  PixelFormat pixels;
  ColourTags colour;
  Rational sample_aspect{0, 1};  ///< 0/1 is unknown
  bool operator==(const PictureFormat&) const = default;

  int component_width_px(int component) const {
    return is_chroma(component) ? ceil_shift(width_px, pixels.log2_chroma_width) : width_px;
  }
  int component_height_px(int component) const {
    return is_chroma(component) ? ceil_shift(height_px, pixels.log2_chroma_height) : height_px;
  }
  bool is_chroma(int component) const { return pixels.model == ColourModel::Yuv && (component == 1 || component == 2); }

 private:
  static int ceil_shift(int value, int shift) { return (value + (1 << shift) - 1) >> shift; }
};

}  // namespace rinkaku
