#include "pipeline/ffmpeg/formats.h"

#include <array>
#include <string_view>
#include <utility>

extern "C" {
#include <libavutil/pixdesc.h>
}

namespace rinkaku::ffmpeg {
namespace {

constexpr std::array<std::pair<AVPixelFormat, AVPixelFormat>, 5> j_formats{{
    {AV_PIX_FMT_YUVJ420P, AV_PIX_FMT_YUV420P},
    {AV_PIX_FMT_YUVJ422P, AV_PIX_FMT_YUV422P},
    {AV_PIX_FMT_YUVJ444P, AV_PIX_FMT_YUV444P},
    {AV_PIX_FMT_YUVJ440P, AV_PIX_FMT_YUV440P},
    {AV_PIX_FMT_YUVJ411P, AV_PIX_FMT_YUV411P},
}};

int bytes_of(const AVComponentDescriptor& c) { return c.depth + c.shift > 8 ? 2 : 1; }

// Whether two components of one plane ever use the same byte.
bool overlap(const AVComponentDescriptor& a, const AVComponentDescriptor& b) {
  if (a.plane != b.plane) return false;
  const int period = a.step > b.step ? a.step : b.step;
  for (int i = a.offset; i < a.offset + period; i += a.step) {
    for (int j = b.offset; j < b.offset + period; j += b.step) {
      if (i < j + bytes_of(b) && j < i + bytes_of(a)) return true;
    }
  }
  return false;
}

bool is_xyz(const AVPixFmtDescriptor& d) { return std::string_view(d.name).starts_with("xyz"); }

int deepest(const AVPixFmtDescriptor& d) {
  int depth = 0;
  for (int c = 0; c < d.nb_components; ++c) depth = d.comp[c].depth > depth ? d.comp[c].depth : depth;
  return depth;
}

}  // namespace

bool addressable(AVPixelFormat format) {
  const AVPixFmtDescriptor* d = av_pix_fmt_desc_get(format);
  if (!d || d->nb_components == 0) return false;
  constexpr std::uint64_t not_plain = AV_PIX_FMT_FLAG_PAL | AV_PIX_FMT_FLAG_BITSTREAM | AV_PIX_FMT_FLAG_HWACCEL |
                                      AV_PIX_FMT_FLAG_BAYER | AV_PIX_FMT_FLAG_FLOAT;
  if (d->flags & not_plain || is_xyz(*d)) return false;
  // Six bytes hold four pixels there: luma has no constant step.
  if (format == AV_PIX_FMT_UYYVYY411) return false;
  for (int a = 0; a < d->nb_components; ++a) {
    if (d->comp[a].depth > 16 || d->comp[a].depth < 1 || d->comp[a].step < bytes_of(d->comp[a])) return false;
    for (int b = 0; b < a; ++b) {
      if (overlap(d->comp[a], d->comp[b])) return false;
    }
  }
  return true;
}

AVPixelFormat nearest_addressable(AVPixelFormat format, bool opaque) {
  if (addressable(format)) return format;
  const AVPixFmtDescriptor* d = av_pix_fmt_desc_get(format);
  if (!d) return AV_PIX_FMT_NONE;
  const bool deep = deepest(*d) > 8;
  if (d->flags & AV_PIX_FMT_FLAG_PAL) return opaque ? AV_PIX_FMT_RGB24 : AV_PIX_FMT_RGBA;
  if (format == AV_PIX_FMT_UYYVYY411) return AV_PIX_FMT_YUV411P;
  if (d->flags & AV_PIX_FMT_FLAG_ALPHA) return deep ? AV_PIX_FMT_RGBA64LE : AV_PIX_FMT_RGBA;
  if (d->flags & (AV_PIX_FMT_FLAG_RGB | AV_PIX_FMT_FLAG_BAYER) || is_xyz(*d)) {
    return deep ? AV_PIX_FMT_RGB48LE : AV_PIX_FMT_RGB24;
  }
  if (d->nb_components == 1) return deep ? AV_PIX_FMT_GRAY16LE : AV_PIX_FMT_GRAY8;
  return deep ? AV_PIX_FMT_YUV444P16LE : AV_PIX_FMT_YUV444P;
}

AVPixelFormat without_j(AVPixelFormat format) {
  for (const auto& [j, plain] : j_formats) {
    if (format == j) return plain;
  }
  return format;
}

bool is_j(AVPixelFormat format) { return without_j(format) != format; }

PixelFormat to_pixel_format(AVPixelFormat format) {
  format = without_j(format);
  const AVPixFmtDescriptor* d = av_pix_fmt_desc_get(format);
  PixelFormat out;
  out.name = d->name;
  out.planes = av_pix_fmt_count_planes(format);
  out.components = d->nb_components;
  out.has_alpha = (d->flags & AV_PIX_FMT_FLAG_ALPHA) != 0;
  out.big_endian = (d->flags & AV_PIX_FMT_FLAG_BE) != 0;
  if (d->flags & AV_PIX_FMT_FLAG_RGB) {
    out.model = ColourModel::Rgb;
  } else if (d->nb_components <= 2) {
    out.model = ColourModel::Grey;
  } else {
    out.model = ColourModel::Yuv;
    out.log2_chroma_width = d->log2_chroma_w;
    out.log2_chroma_height = d->log2_chroma_h;
  }
  for (int c = 0; c < d->nb_components; ++c) {
    const AVComponentDescriptor& from = d->comp[c];
    out.component[static_cast<std::size_t>(c)] = {from.plane, from.step, from.offset, from.shift, from.depth};
  }
  return out;
}

AVPixelFormat to_av(const PixelFormat& format) { return av_get_pix_fmt(format.name.c_str()); }

namespace {

ColourTags::Range range_of(AVColorRange range, AVPixelFormat format) {
  if (range == AVCOL_RANGE_JPEG || is_j(format)) return ColourTags::Range::Full;
  return range == AVCOL_RANGE_MPEG ? ColourTags::Range::Limited : ColourTags::Range::Unspecified;
}

AVColorRange to_av(ColourTags::Range range) {
  switch (range) {
    case ColourTags::Range::Full:
      return AVCOL_RANGE_JPEG;
    case ColourTags::Range::Limited:
      return AVCOL_RANGE_MPEG;
    case ColourTags::Range::Unspecified:
      break;
  }
  return AVCOL_RANGE_UNSPECIFIED;
}

template <class Context>
void set_tags(Context& to, AVChromaLocation& chroma_location, const ColourTags& colour) {
  to.color_primaries = static_cast<AVColorPrimaries>(colour.primaries);
  to.color_trc = static_cast<AVColorTransferCharacteristic>(colour.transfer);
  to.colorspace = static_cast<AVColorSpace>(colour.matrix);
  to.color_range = to_av(colour.range);
  chroma_location = static_cast<AVChromaLocation>(colour.chroma_location);
}

}  // namespace

ColourTags colour_of(const AVFrame& frame) {
  ColourTags tags;
  tags.primaries = frame.color_primaries;
  tags.transfer = frame.color_trc;
  tags.matrix = frame.colorspace;
  tags.range = range_of(frame.color_range, static_cast<AVPixelFormat>(frame.format));
  tags.chroma_location = frame.chroma_location;
  return tags;
}

void set_colour(AVFrame& frame, const ColourTags& colour) { set_tags(frame, frame.chroma_location, colour); }
void set_colour(AVCodecContext& codec, const ColourTags& colour) {
  set_tags(codec, codec.chroma_sample_location, colour);
}

int assumed_matrix(int width_px, int height_px) {
  return width_px >= 1280 || height_px > 576 ? AVCOL_SPC_BT709 : AVCOL_SPC_SMPTE170M;
}

}  // namespace rinkaku::ffmpeg
