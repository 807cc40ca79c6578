#include "pipeline/track/luma.h"

#include <cstdint>

namespace rinkaku::track {
namespace {

// One component's samples of a row, brought to 8 bits.
class SampleReader {
 public:
  SampleReader(const Frame& frame, int index)
      : component_(frame.format.pixels.component[static_cast<std::size_t>(index)]),
        plane_(frame.planes[static_cast<std::size_t>(component_.plane)]),
        big_endian_(frame.format.pixels.big_endian),
        two_bytes_(component_.depth_bits + component_.shift_bits > 8),
        mask_((1u << component_.depth_bits) - 1) {}

  const std::uint8_t* row(int y) const { return plane_.data + y * plane_.stride_bytes + component_.offset_bytes; }

  unsigned sample(const std::uint8_t* row, int x) const {
    const std::uint8_t* at = row + static_cast<std::ptrdiff_t>(x) * component_.step_bytes;
    unsigned raw = at[0];
    if (two_bytes_) raw = big_endian_ ? raw << 8 | at[1] : raw | static_cast<unsigned>(at[1]) << 8;
    raw = (raw >> component_.shift_bits) & mask_;
    const int depth = component_.depth_bits;
    if (depth == 8) return raw;
    return depth > 8 ? raw >> (depth - 8) : raw * 255 / mask_;
  }

  bool is_plain_8_bit() const {
    return component_.step_bytes == 1 && component_.depth_bits == 8 && component_.shift_bits == 0;
  }
  std::ptrdiff_t stride_bytes() const { return plane_.stride_bytes; }

 private:
  const Component& component_;
  const Plane& plane_;
  bool big_endian_;
  bool two_bytes_;
  unsigned mask_;
};

}  // namespace

cv::Mat luma(const Frame& frame, cv::Mat& scratch) {
  const PictureFormat& format = frame.format;
  const int width = format.width_px, height = format.height_px;
  const SampleReader first(frame, 0);
  const bool rgb = format.pixels.model == ColourModel::Rgb;
  // OpenCV's rows run downwards in memory; a picture stored bottom up is copied.
  if (!rgb && first.is_plain_8_bit() && first.stride_bytes() > 0) {
    return {height, width, CV_8UC1, const_cast<std::uint8_t*>(first.row(0)),
            static_cast<std::size_t>(first.stride_bytes())};
  }
  scratch.create(height, width, CV_8UC1);
  if (rgb) {
    const SampleReader green(frame, 1), blue(frame, 2);
    for (int y = 0; y < height; ++y) {
      const auto *r = first.row(y), *g = green.row(y), *b = blue.row(y);
      auto* out = scratch.ptr<std::uint8_t>(y);
      for (int x = 0; x < width; ++x) {
        const unsigned sum = 77 * first.sample(r, x) + 150 * green.sample(g, x) + 29 * blue.sample(b, x);
        out[x] = static_cast<std::uint8_t>((sum + 128) >> 8);
      }
    }
    return scratch;
  }
  for (int y = 0; y < height; ++y) {
    const auto* in = first.row(y);
    auto* out = scratch.ptr<std::uint8_t>(y);
    for (int x = 0; x < width; ++x) out[x] = static_cast<std::uint8_t>(first.sample(in, x));
  }
  return scratch;
}

}  // namespace rinkaku::track
