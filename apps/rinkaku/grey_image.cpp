#include "apps/rinkaku/grey_image.h"

#include <algorithm>
#include <utility>

#include "pipeline/frame/colour_matrix.h"
#include "pipeline/frame/error.h"
#include "pipeline/source/picture_file.h"

namespace rinkaku::app {
namespace {

// One component of a picture, each sample over the largest that its depth holds.
class Samples {
 public:
  Samples(const Frame& frame, int component)
      : component_(frame.format.pixels.component[static_cast<std::size_t>(component)]),
        plane_(frame.planes[static_cast<std::size_t>(component_.plane)]),
        two_bytes_(component_.depth_bits + component_.shift_bits > 8),
        high_byte_(frame.format.pixels.big_endian ? 0 : 1),
        largest_((1U << component_.depth_bits) - 1) {}

  float at(int x_px, int y_px) const {
    const std::uint8_t* bytes =
        plane_.data + y_px * plane_.stride_bytes + x_px * component_.step_bytes + component_.offset_bytes;
    const unsigned word = two_bytes_ ? static_cast<unsigned>(bytes[high_byte_] << 8 | bytes[1 - high_byte_]) : *bytes;
    return static_cast<float>(word >> component_.shift_bits & largest_) / static_cast<float>(largest_);
  }

 private:
  Component component_;
  Plane plane_;
  bool two_bytes_;
  int high_byte_;
  unsigned largest_;
};

matte::GreyMatte matte_of(const Frame& frame, int component) {
  matte::GreyMatte matte{frame.format.width_px, frame.format.height_px, {}};
  matte.alpha.reserve(static_cast<std::size_t>(matte.width_px) * static_cast<std::size_t>(matte.height_px));
  const Samples samples(frame, component);
  for (int y = 0; y < matte.height_px; ++y) {
    for (int x = 0; x < matte.width_px; ++x) matte.alpha.push_back(samples.at(x, y));
  }
  return matte;
}

}  // namespace

matte::GreyMatte read_grey(const std::string& path) {
  Frame frame = source::read_picture(path);
  if (frame.format.pixels.has_alpha) return matte_of(frame, frame.format.pixels.components - 1);
  if (frame.format.pixels.model == ColourModel::Grey) return matte_of(frame, 0);
  // Grey pictures are often stored in colour.
  if (frame.format.pixels.model == ColourModel::Yuv) frame = source::to_rgba(frame);
  matte::GreyMatte red = matte_of(frame, 0);
  if (matte_of(frame, 1).alpha != red.alpha || matte_of(frame, 2).alpha != red.alpha) {
    throw input_error(path, "is a colour picture without alpha", "give a grey one, or one with an alpha channel");
  }
  return red;
}

matte::GreyMatte grey_of(const Frame& frame) {
  if (frame.format.pixels.has_alpha) return matte_of(frame, frame.format.pixels.components - 1);
  matte::GreyMatte grey = matte_of(frame, 0);
  if (frame.format.pixels.model == ColourModel::Yuv && !is_full_range(frame.format)) {
    for (float& value : grey.alpha) value = std::clamp((value * 255 - 16) / 219, 0.0f, 1.0f);
  }
  return grey;
}

}  // namespace rinkaku::app
