#pragma once

#include <string>

#include "pipeline/ffmpeg/handles.h"
#include "pipeline/frame/picture_format.h"

namespace rinkaku::sink {

/// The pictures that an encoder gets for those that come.
struct EncoderFormat {
  PictureFormat picture;  ///< equal to what comes if nothing has to be converted
  AVPixelFormat label =
      AV_PIX_FMT_NONE;  ///< the encoder's name for it: a yuvj format may stand for yuv with full range
  std::string notice;   ///< one line on the conversion, if there is one
};

/// What comes, if the encoder takes it; else the best of what it takes. Throws Error (Input) if FFmpeg has no such
/// format.
EncoderFormat choose_encoder_format(const AVCodec& encoder, const PictureFormat& coming);

/// The same for anything that takes the formats of a list that AV_PIX_FMT_NONE ends (null: all). `must_be_full` asks
/// for full range.
EncoderFormat choose_format(const std::string& taker, const AVPixelFormat* taken, const PictureFormat& coming,
                            bool must_be_full = false);

}  // namespace rinkaku::sink
