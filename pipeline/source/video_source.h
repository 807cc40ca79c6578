#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "pipeline/ffmpeg/converter.h"
#include "pipeline/source/input_file.h"
#include "pipeline/source/source.h"

namespace rinkaku::source {

/// A file or image sequence through FFmpeg's demuxers and decoders; see source::open().
class VideoSource final : public Source {
 public:
  VideoSource(Input input, const OpenOptions& options);

  const Description& description() const override { return description_; }
  std::optional<Frame> next() override;
  std::string damage() const override;

 private:
  struct Damage {
    std::int64_t packets = 0;   ///< that the decoder refused
    std::int64_t pictures = 0;  ///< decoded with errors
    std::int64_t resized = 0;   ///< of another size or format than the first
    std::int64_t times = 0;     ///< that were missing or did not rise
    std::string cut;            ///< why the file ended early
  };

  ffmpeg::FramePtr decode();
  bool feed();
  void end_of_file(int code);
  void describe(const AVFrame& first);
  void read_container(const AVFrame& first);
  Frame deliver(ffmpeg::FramePtr picture);
  void stamp(Frame& frame, const AVFrame& picture);
  AVStream& stream() const { return *demuxer_.context->streams[demuxer_.video_stream]; }

  Input input_;
  Demuxer demuxer_;
  ffmpeg::CodecPtr decoder_;
  ffmpeg::LogListener decoder_errors_;
  ffmpeg::PacketPtr packet_;
  ffmpeg::FramePtr first_;  ///< decoded when opened, delivered by the first next()
  Description description_;
  std::optional<ffmpeg::Converter> converter_;
  AVPixelFormat stored_format_ = AV_PIX_FMT_NONE;  ///< of the first picture, as decoded
  int stored_width_px_ = 0, stored_height_px_ = 0;
  bool always_convert_ = false;
  bool draining_ = false;
  bool container_interlaced_ = false;
  bool container_top_first_ = false;
  int errors_in_a_row_ = 0;
  std::int64_t packets_read_ = 0;
  std::int64_t next_number_ = 0;
  std::int64_t last_pts_ = 0;
  std::int64_t step_ = 1;  ///< of pts from picture to picture, as the frame rate has it
  std::int64_t last_end_ = 0;
  Damage damage_;
};

}  // namespace rinkaku::source
