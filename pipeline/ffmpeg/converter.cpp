#include "pipeline/ffmpeg/converter.h"

#include <string>

extern "C" {
#include <libavutil/pixdesc.h>
}

#include "pipeline/ffmpeg/formats.h"
#include "pipeline/frame/error.h"

namespace rinkaku::ffmpeg {
namespace {

const int* coefficients(int matrix, int width, int height) {
  if (matrix == AVCOL_SPC_UNSPECIFIED || matrix == AVCOL_SPC_RGB) matrix = assumed_matrix(width, height);
  return sws_getCoefficients(matrix);
}

bool is_grey(AVPixelFormat format) { return av_pix_fmt_desc_get(format)->nb_components <= 2; }

}  // namespace

void Converter::prepare(const AVFrame& from) {
  const ColourTags colour = colour_of(from);
  if (scaler_ && from.width == width_ && from.height == height_ && from.format == format_ && colour == colour_) return;
  const auto source = static_cast<AVPixelFormat>(from.format);
  const AVPixelFormat target = to_av(to_.pixels);
  // Chroma is filtered, and rounded rightly, not taken from the nearest sample.
  const int flags = SWS_BICUBIC | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT | SWS_FULL_CHR_H_INP;
  if (sws_isSupportedInput(source) && sws_isSupportedOutput(target)) {
    scaler_.reset(sws_getContext(from.width, from.height, without_j(source), to_.width_px, to_.height_px, target, flags,
                                 nullptr, nullptr, nullptr));
  }
  if (!scaler_) {
    throw input_error("",
                      std::string("pictures of the format ") + av_get_pix_fmt_name(source) + " can't be converted to " +
                          to_.pixels.name,
                      "convert the file to another pixel format first");
  }
  // swscale takes every grey picture for full range: with the same range on both sides it keeps the values.
  const bool values_kept = is_grey(source) != is_grey(target) &&
                           !(av_pix_fmt_desc_get(is_grey(source) ? target : source)->flags & AV_PIX_FMT_FLAG_RGB);
  const int from_full = values_kept || colour.range == ColourTags::Range::Full;
  const int to_full = values_kept || to_.colour.range == ColourTags::Range::Full;
  sws_setColorspaceDetails(scaler_.get(), coefficients(colour.matrix, from.width, from.height), from_full,
                           coefficients(to_.colour.matrix, to_.width_px, to_.height_px), to_full, 0, 1 << 16, 1 << 16);
  width_ = from.width;
  height_ = from.height;
  format_ = from.format;
  colour_ = colour;
}

Frame Converter::convert(const AVFrame& from) {
  prepare(from);
  Frame out = pool_.allocate(to_);
  std::uint8_t* data[4] = {};
  int strides[4] = {};
  for (int p = 0; p < to_.pixels.planes; ++p) {
    data[p] = out.planes[static_cast<std::size_t>(p)].data;
    strides[p] = static_cast<int>(out.planes[static_cast<std::size_t>(p)].stride_bytes);
  }
  sws_scale(scaler_.get(), from.data, from.linesize, 0, from.height, data, strides);
  return out;
}

}  // namespace rinkaku::ffmpeg
