#include "pipeline/sink/yuyv_packer.h"

#include <libyuv.h>

#include "pipeline/ffmpeg/formats.h"
#include "pipeline/ffmpeg/frames.h"

namespace rinkaku::sink {
namespace {

PictureFormat planar_format(const PictureFormat& coming) {
  PictureFormat format = coming;
  format.pixels = ffmpeg::to_pixel_format(AV_PIX_FMT_YUV422P);
  format.colour.range = ColourTags::Range::Limited;
  // What nothing is said of is taken as players take it; readers want to be told.
  if (coming.pixels.model != ColourModel::Yuv || coming.colour.matrix == AVCOL_SPC_UNSPECIFIED) {
    format.colour.matrix = ffmpeg::assumed_matrix(coming.width_px, coming.height_px);
  }
  return format;
}

bool packs_as_it_is(const PictureFormat& format) {
  const bool planar = format.pixels.name == "yuv422p" || format.pixels.name == "yuv420p";
  return planar && format.colour.range != ColourTags::Range::Full;
}

}  // namespace

YuyvPacker::YuyvPacker(const PictureFormat& coming)
    : planar_(planar_format(coming)), stride_bytes_((coming.width_px + 1) / 2 * 4) {
  packed_.resize(static_cast<std::size_t>(stride_bytes_) * static_cast<std::size_t>(coming.height_px));
  if (!packs_as_it_is(coming)) converter_.emplace(planar_);
}

std::span<const std::uint8_t> YuyvPacker::pack(const Frame& frame) {
  Frame converted;
  const Frame* from = &frame;
  if (converter_) {
    const ffmpeg::FramePtr wrapped = ffmpeg::wrap(frame);
    converted = converter_->convert(*wrapped);
    from = &converted;
  }
  const auto data = [&](std::size_t plane) { return from->planes[plane].data; };
  const auto stride = [&](std::size_t plane) { return static_cast<int>(from->planes[plane].stride_bytes); };
  const auto by = from->format.pixels.name == "yuv420p" ? libyuv::I420ToYUY2 : libyuv::I422ToYUY2;
  by(data(0), stride(0), data(1), stride(1), data(2), stride(2), packed_.data(), stride_bytes_, planar_.width_px,
     planar_.height_px);
  return packed_;
}

}  // namespace rinkaku::sink
