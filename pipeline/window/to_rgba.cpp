#include "pipeline/window/to_rgba.h"

#include <cstring>

#include <libyuv.h>

#include "pipeline/ffmpeg/converter.h"
#include "pipeline/ffmpeg/formats.h"
#include "pipeline/ffmpeg/frames.h"
#include "pipeline/passes/composite/colour_matrix.h"

namespace rinkaku::window {
namespace {

// libyuv's constants with U and V exchanged make R G B A of what it calls ARGB; null for a matrix that it hasn't.
const libyuv::YuvConstants* constants_for(const PictureFormat& format) {
  const bool full = passes::is_full_range(format);
  switch (passes::effective_matrix(format)) {
    case 1:
      return full ? &libyuv::kYvuF709Constants : &libyuv::kYvuH709Constants;
    case 5:
    case 6:
      return full ? &libyuv::kYvuJPEGConstants : &libyuv::kYvuI601Constants;
    case 9:
      return full ? &libyuv::kYvuV2020Constants : &libyuv::kYvu2020Constants;
    default:
      return nullptr;
  }
}

// False if libyuv has no way for such frames.
bool by_libyuv(const Frame& frame, std::uint8_t* rgba) {
  const libyuv::YuvConstants* constants = constants_for(frame.format);
  if (!constants) return false;
  const auto data = [&](std::size_t plane) { return frame.planes[plane].data; };
  const auto stride = [&](std::size_t plane) { return static_cast<int>(frame.planes[plane].stride_bytes); };
  const int width = frame.format.width_px, height = frame.format.height_px;
  const std::string& name = frame.format.pixels.name;
  if (name == "gray") {
    return libyuv::I400ToARGBMatrix(data(0), stride(0), rgba, width * 4, constants, width, height) == 0;
  }
  const auto convert = [&](auto function) {
    return function(data(0), stride(0), data(2), stride(2), data(1), stride(1), rgba, width * 4, constants, width,
                    height) == 0;
  };
  if (name == "yuv420p") return convert(libyuv::I420ToARGBMatrix);
  if (name == "yuv422p") return convert(libyuv::I422ToARGBMatrix);
  if (name == "yuv444p") return convert(libyuv::I444ToARGBMatrix);
  return false;
}

PictureFormat rgba_format(const PictureFormat& of) {
  PictureFormat format;
  format.width_px = of.width_px;
  format.height_px = of.height_px;
  format.pixels = ffmpeg::to_pixel_format(AV_PIX_FMT_RGBA);
  format.colour = {of.colour.primaries, of.colour.transfer, 0, ColourTags::Range::Full, 0};
  return format;
}

}  // namespace

struct RgbaConverter::Scaler {
  explicit Scaler(const PictureFormat& format) : converter(rgba_format(format)) {}
  ffmpeg::Converter converter;
};

RgbaConverter::RgbaConverter() = default;
RgbaConverter::~RgbaConverter() = default;

const std::uint8_t* RgbaConverter::convert(const Frame& frame) {
  const auto width = static_cast<std::size_t>(frame.format.width_px);
  const auto height = static_cast<std::size_t>(frame.format.height_px);
  rgba_.resize(width * height * 4);
  if (by_libyuv(frame, rgba_.data())) return rgba_.data();
  if (!scaler_ || scaler_->converter.to().width_px != frame.format.width_px ||
      scaler_->converter.to().height_px != frame.format.height_px) {
    scaler_ = std::make_unique<Scaler>(frame.format);
  }
  const ffmpeg::FramePtr wrapped = ffmpeg::wrap(frame);
  const Frame converted = scaler_->converter.convert(*wrapped);
  for (std::size_t y = 0; y < height; ++y) {
    std::memcpy(rgba_.data() + y * width * 4,
                converted.planes[0].data + static_cast<std::ptrdiff_t>(y) * converted.planes[0].stride_bytes,
                width * 4);
  }
  if (frame.format.pixels.has_alpha) {
    // CG alone is shown on grey.
    for (std::size_t i = 0; i < width * height * 4; i += 4) {
      const int alpha = rgba_[i + 3];
      for (std::size_t c = 0; c < 3; ++c) {
        rgba_[i + c] = static_cast<std::uint8_t>((rgba_[i + c] * alpha + 128 * (255 - alpha) + 127) / 255);
      }
      rgba_[i + 3] = 255;
    }
  }
  return rgba_.data();
}

}  // namespace rinkaku::window
