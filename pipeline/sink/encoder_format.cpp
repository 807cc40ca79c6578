#include "pipeline/sink/encoder_format.h"

#include <algorithm>
#include <vector>

#include "pipeline/ffmpeg/formats.h"
#include "pipeline/frame/error.h"

namespace rinkaku::sink {
namespace {

// What can't be addressed can't be made here either.
std::vector<AVPixelFormat> usable(const AVPixelFormat* list) {
  std::vector<AVPixelFormat> formats;
  for (; list && *list != AV_PIX_FMT_NONE; ++list) {
    if (ffmpeg::addressable(*list)) formats.push_back(*list);
  }
  return formats;
}

bool contains(const std::vector<AVPixelFormat>& formats, AVPixelFormat format) {
  return std::find(formats.begin(), formats.end(), format) != formats.end();
}

AVPixelFormat j_of(const std::vector<AVPixelFormat>& formats, AVPixelFormat plain) {
  const auto j = std::find_if(formats.begin(), formats.end(),
                              [plain](AVPixelFormat f) { return ffmpeg::is_j(f) && ffmpeg::without_j(f) == plain; });
  return j == formats.end() ? AV_PIX_FMT_NONE : *j;
}

bool lossless(const PixelFormat& from, const PixelFormat& to) {
  if (from.has_alpha && !to.has_alpha) return false;
  if (from.component[0].depth_bits != to.component[0].depth_bits) return false;
  if (from.model == ColourModel::Grey) return to.model != ColourModel::Rgb;
  return from.model == to.model && from.log2_chroma_width == to.log2_chroma_width &&
         from.log2_chroma_height == to.log2_chroma_height;
}

ColourTags converted_colour(const PictureFormat& coming, const PixelFormat& to, bool to_full) {
  ColourTags colour = coming.colour;
  if (to.model == ColourModel::Rgb && coming.pixels.model != ColourModel::Rgb) {
    colour.matrix = AVCOL_SPC_RGB;
    colour.range = ColourTags::Range::Full;
    colour.chroma_location = 0;
  } else if (to.model == ColourModel::Yuv && coming.pixels.model == ColourModel::Rgb) {
    colour.matrix = ffmpeg::assumed_matrix(coming.width_px, coming.height_px);
    colour.range = ColourTags::Range::Limited;
  }
  if (to_full) colour.range = ColourTags::Range::Full;
  return colour;
}

}  // namespace

EncoderFormat choose_encoder_format(const AVCodec& encoder, const PictureFormat& coming) {
  // JPEG is full range by definition.
  const bool must_be_full = encoder.id == AV_CODEC_ID_MJPEG && coming.pixels.model == ColourModel::Yuv;
  return choose_format(encoder.name, encoder.pix_fmts, coming, must_be_full);
}

EncoderFormat choose_format(const std::string& taker, const AVPixelFormat* taken, const PictureFormat& coming,
                            bool must_be_full) {
  EncoderFormat out{coming, ffmpeg::to_av(coming.pixels), {}};
  const AVPixelFormat source = out.label;
  if (source == AV_PIX_FMT_NONE) throw input_error("", "FFmpeg knows no pixel format \"" + coming.pixels.name + "\"");
  const auto formats = usable(taken);
  const bool full = coming.colour.range == ColourTags::Range::Full;
  const AVPixelFormat j = j_of(formats, source);
  if (full && j != AV_PIX_FMT_NONE && (must_be_full || !contains(formats, source))) {
    out.label = j;
    return out;
  }
  if (formats.empty() || (contains(formats, source) && !must_be_full)) return out;
  if (must_be_full && j != AV_PIX_FMT_NONE) {
    out.label = j;
  } else {
    auto list = formats;
    list.push_back(AV_PIX_FMT_NONE);
    out.label = avcodec_find_best_pix_fmt_of_list(list.data(), source, coming.pixels.has_alpha, nullptr);
  }
  out.picture.pixels = ffmpeg::to_pixel_format(out.label);
  out.picture.colour = converted_colour(coming, out.picture.pixels, ffmpeg::is_j(out.label));
  out.notice = taker + " takes no " + coming.pixels.name;
  if (out.picture.pixels == coming.pixels) {
    out.notice = taker + " takes only full range: pictures are converted";
  } else {
    out.notice += ": pictures are converted to " + out.picture.pixels.name;
    if (lossless(coming.pixels, out.picture.pixels)) out.notice += " without loss";
    if (coming.pixels.has_alpha && !out.picture.pixels.has_alpha) out.notice += ", their alpha is lost";
  }
  return out;
}

}  // namespace rinkaku::sink
