#pragma once

#include "pipeline/ffmpeg/handles.h"
#include "pipeline/frame/picture_format.h"

namespace rinkaku::ffmpeg {

inline AVRational to_av(Rational r) { return {static_cast<int>(r.num), static_cast<int>(r.den)}; }
inline Rational from_av(AVRational r) { return r.den == 0 ? Rational{0, 1} : Rational{r.num, r.den}; }

/// Whether each component is an integer sample of its own in memory, as PixelFormat describes it. Palettes, bit
/// streams, Bayer patterns, floating point, pixels packed into one word and frames in a device's memory are not.
bool addressable(AVPixelFormat format);

/// The addressable format that holds such a picture best; `opaque` palettes need no alpha.
AVPixelFormat nearest_addressable(AVPixelFormat format, bool opaque);

/// yuvj420p and its like are yuv420p whose range is full; every other format is itself.
AVPixelFormat without_j(AVPixelFormat format);
bool is_j(AVPixelFormat format);

/// Precondition: addressable(format). yuvj formats get their plain name.
PixelFormat to_pixel_format(AVPixelFormat format);

/// By name; AV_PIX_FMT_NONE if FFmpeg has no such format.
AVPixelFormat to_av(const PixelFormat& format);

ColourTags colour_of(const AVFrame& frame);
void set_colour(AVFrame& frame, const ColourTags& colour);
void set_colour(AVCodecContext& codec, const ColourTags& colour);

/// The matrix that samples without a stated one are read by, as players do: BT.709 from 1280 pixels of width or 577 of
/// height on, else BT.601 (H.273's code points 1 and 6).
int assumed_matrix(int width_px, int height_px);

}  // namespace rinkaku::ffmpeg
