#include "pipeline/sink/codec_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <thread>

extern "C" {
#include <libavutil/opt.h>
}

#include "pipeline/frame/error.h"

namespace rinkaku::sink {
namespace {

// Names that people use for what FFmpeg calls otherwise.
constexpr std::array<std::array<std::string_view, 2>, 6> aliases{{{"h264", "libx264"},
                                                                  {"x264", "libx264"},
                                                                  {"h265", "libx265"},
                                                                  {"hevc", "libx265"},
                                                                  {"vp9", "libvpx-vp9"},
                                                                  {"raw", "rawvideo"}}};

struct ConstantQuality {
  std::string_view encoder;
  const char* options;
};
// libvpx is unbearably slow without the two others.
constexpr std::array<ConstantQuality, 5> constant_quality{{{"libx264", "crf=18"},
                                                           {"libx264rgb", "crf=18"},
                                                           {"libx265", "crf=20"},
                                                           {"libvpx-vp9", "crf=24:row-mt=1:cpu-used=4"},
                                                           {"libsvtav1", "crf=24"}}};

const AVCodec* find_encoder(std::string_view name) {
  for (const auto& [alias, encoder] : aliases) {
    if (name == alias) name = encoder;
  }
  const std::string wanted(name);
  const AVCodec* codec = avcodec_find_encoder_by_name(wanted.c_str());
  if (!codec) {
    if (const AVCodecDescriptor* known = avcodec_descriptor_get_by_name(wanted.c_str())) {
      codec = avcodec_find_encoder(known->id);
    }
  }
  return codec && codec->type == AVMEDIA_TYPE_VIDEO ? codec : nullptr;
}

const AVOutputFormat* find_container(const Options& options) {
  if (options.container == "y4m") return av_guess_format("yuv4mpegpipe", nullptr, nullptr);
  if (options.container == "raw") return av_guess_format("rawvideo", nullptr, nullptr);
  if (!options.container.empty()) return av_guess_format(options.container.c_str(), nullptr, nullptr);
  return av_guess_format(nullptr, options.path.c_str(), nullptr);
}

const AVCodec* default_encoder(const AVOutputFormat& container, const std::string& path) {
  const std::string_view name = container.name;
  if (name == "rawvideo") return avcodec_find_encoder(AV_CODEC_ID_RAWVIDEO);
  if (name == "webm") return find_encoder("vp9");
  const AVCodecID id = av_guess_codec(&container, nullptr, path.c_str(), nullptr, AVMEDIA_TYPE_VIDEO);
  return id == AV_CODEC_ID_H264 ? find_encoder("h264") : avcodec_find_encoder(id);
}

}  // namespace

CodecChoice choose_video_codec(const Options& options) {
  CodecChoice choice;
  choice.container = find_container(options);
  if (!choice.container) {
    if (options.path == "-") throw input_error("standard output", "no container is given", "give y4m or raw");
    throw input_error(options.path, "its ending tells no video or image format",
                      "give a name ending in .mp4, .mkv, .mov or .avi, or a pattern like out/%04d.png");
  }
  choice.encoder =
      options.codec.empty() ? default_encoder(*choice.container, options.path) : find_encoder(options.codec);
  if (!choice.encoder) {
    if (options.codec.empty()) {
      throw input_error(options.path, std::string("the container ") + choice.container->name + " holds no video",
                        "choose a name ending in .mp4, .mkv, .mov or .avi");
    }
    throw input_error(options.path, "there is no encoder \"" + options.codec + "\"",
                      "choose libx264, mpeg4, ffv1, ffvhuff or another of `ffmpeg -encoders`");
  }
  return choice;
}

const AVCodec* image_encoder(const std::string& path) {
  const AVOutputFormat* images = av_guess_format("image2", nullptr, nullptr);
  const AVOutputFormat* guessed = av_guess_format(nullptr, path.c_str(), nullptr);
  if (!images || guessed != images) return nullptr;
  const AVCodecID id = av_guess_codec(images, nullptr, path.c_str(), nullptr, AVMEDIA_TYPE_VIDEO);
  return id == AV_CODEC_ID_NONE ? nullptr : avcodec_find_encoder(id);
}

void set_quality(AVCodecContext& encoder, std::int64_t bit_rate) {
  const std::string_view name = encoder.codec->name;
  if (encoder.codec_id == AV_CODEC_ID_FFV1) {
    encoder.level = 3;
    // FFmpeg refuses to slice small pictures of odd sizes, and they gain nothing by it.
    if (encoder.width <= 352 && encoder.height <= 288) return;
    const unsigned threads =
        encoder.thread_count > 0 ? static_cast<unsigned>(encoder.thread_count) : std::thread::hardware_concurrency();
    encoder.slices = threads <= 4 ? 4 : threads <= 12 ? 12 : 24;  // numbers that FFV1's grid of slices knows
    return;
  }
  if (bit_rate > 0) {
    encoder.bit_rate = bit_rate;
    return;
  }
  for (const auto& [codec, settings] : constant_quality) {
    if (name != codec) continue;
    encoder.bit_rate = 0;
    av_set_options_string(encoder.priv_data, settings, "=", ":");
    return;
  }
  const AVCodecDescriptor* descriptor = avcodec_descriptor_get(encoder.codec_id);
  if (descriptor && !(descriptor->props & AV_CODEC_PROP_LOSSLESS)) {
    encoder.flags |= AV_CODEC_FLAG_QSCALE;
    encoder.global_quality = 3 * FF_QP2LAMBDA;
  }
}

void set_for_recording(AVCodecContext& encoder) {
  encoder.max_b_frames = 0;
  if (encoder.framerate.num > 0) {
    encoder.gop_size = std::max(1, static_cast<int>(std::lround(av_q2d(encoder.framerate))));
  }
  // Threads that share frames, not slices, hold as many back.
  if (encoder.codec->capabilities & AV_CODEC_CAP_SLICE_THREADS) encoder.thread_type = FF_THREAD_SLICE;
  const std::string_view name = encoder.codec->name;
  if (name == "libx264" || name == "libx265") {
    av_opt_set(encoder.priv_data, "preset", "veryfast", 0);
    av_opt_set(encoder.priv_data, "tune", "zerolatency", 0);
  } else if (name == "libvpx-vp9") {
    av_opt_set(encoder.priv_data, "deadline", "realtime", 0);
    av_opt_set(encoder.priv_data, "lag-in-frames", "0", 0);
  }
}

}  // namespace rinkaku::sink
