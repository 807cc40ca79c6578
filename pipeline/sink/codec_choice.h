#pragma once

#include "pipeline/ffmpeg/handles.h"
#include "pipeline/sink/sink.h"

namespace rinkaku::sink {

/// The encoder and the container that Options ask for.
struct CodecChoice {
  const AVCodec* encoder = nullptr;
  const AVOutputFormat* container = nullptr;
};

/// By Options::codec and Options::container where given, else by the ending. Throws Error (Input) if FFmpeg has none of
/// that name.
CodecChoice choose_video_codec(const Options& options);

/// The encoder for an image of that ending; null if the ending is none of an image.
const AVCodec* image_encoder(const std::string& path);

/// Sets the quality that is good for work: visually lossless where a codec loses anything, at the encoder's usual
/// speed. libx264: crf 18; other constant-quality encoders accordingly; MPEG-4 and its kin: quantiser 3; or `bit_rate`,
/// if given. FFV1: version 3 with slices, so that threads can share a picture.
void set_quality(AVCodecContext& encoder, std::int64_t bit_rate);

/// Lets an encoder keep pace with a camera, holding no frame back: libx264 fast and without looking ahead, a key frame
/// each second. To be called after set_quality() and with the frame rate set.
void set_for_recording(AVCodecContext& encoder);

}  // namespace rinkaku::sink
