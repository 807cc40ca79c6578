#include "pipeline/matte/file_matte.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "pipeline/frame/colour_matrix.h"
#include "pipeline/frame/error.h"

namespace rinkaku::matte {
namespace {

// The frame's last component as a grey picture.
Frame alpha_alone(const Frame& frame) {
  Frame alpha = frame;
  PixelFormat& pixels = alpha.format.pixels;
  pixels.component[0] = pixels.component[static_cast<std::size_t>(pixels.components - 1)];
  pixels.components = 1;
  pixels.has_alpha = false;
  pixels.model = ColourModel::Grey;
  alpha.format.colour.range = ColourTags::Range::Full;
  return alpha;
}

std::array<std::uint8_t, 256> levels(bool full_range) {
  std::array<std::uint8_t, 256> out{};
  for (int i = 0; i < 256; ++i) {
    const double value = full_range ? i : (i - 16) * 255.0 / 219;
    out[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
  }
  return out;
}

std::string size(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

}  // namespace

FileMatte::FileMatte(std::string where, NextFrame next) : where_(std::move(where)), next_(std::move(next)) {}

void FileMatte::estimate(const Frame& frame, Matte& matte) {
  std::optional<Frame> read = next_();
  while (read && read->number < frame.number) read = next_();
  if (!read) {
    throw input_error(where_, "the mattes end before frame " + std::to_string(frame.number) + " of the plate",
                      "give one matte for each frame");
  }
  const int width = frame.format.width_px, height = frame.format.height_px;
  if (read->format.width_px != width || read->format.height_px != height) {
    throw input_error(where_,
                      "the mattes are " + size(read->format.width_px, read->format.height_px) + " and the plate is " +
                          size(width, height),
                      "give mattes of the plate's size");
  }
  begin_matte(frame, matte);
  const Frame alpha = read->format.pixels.has_alpha ? alpha_alone(*read) : std::move(*read);
  const cv::Mat luma = reader_.read(alpha).luma;
  const std::array<std::uint8_t, 256> level = levels(is_full_range(alpha.format));
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* in = luma.ptr<std::uint8_t>(y);
    std::uint8_t* out = matte.alpha_row(y);
    for (int x = 0; x < width; ++x) out[x] = level[in[x]];
  }
  find_rect(matte);
}

}  // namespace rinkaku::matte
