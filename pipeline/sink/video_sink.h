#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "pipeline/files/pending_file.h"
#include "pipeline/sink/encoder.h"
#include "pipeline/sink/sink.h"
#include "pipeline/sink/stream_copy.h"

namespace rinkaku::sink {

/// A video file, device or pipe through FFmpeg's encoders and muxers; see sink::open().
class VideoSink final : public Sink {
 public:
  VideoSink(const Options& options, const Incoming& incoming);
  ~VideoSink() override;

  void write(const Frame& frame) override;
  void finish() override;
  std::string notice() const override { return notice_; }

 private:
  void write_in_small_pieces();
  void add_video_stream();
  void add_rotation();
  void check_rates() const;
  void say(const std::string& what);
  void say_what_is_lost();
  void start(const Frame& first);
  void drain();
  void check(int code) const;
  std::int64_t output_pts(const Frame& frame) const;
  void close_io();

  Options options_;
  Incoming incoming_;
  CodecChoice choice_;
  bool avi_ = false;
  files::PendingFile file_;
  ffmpeg::OutputPtr muxer_;
  std::unique_ptr<ffmpeg::LogListener> listener_;
  std::unique_ptr<Encoder> encoder_;
  std::unique_ptr<StreamCopy> copy_;
  ffmpeg::PacketPtr packet_;
  AVRational unit_{1, 1};   ///< of the video's times before the muxer rounds them
  std::int64_t shift_ = 0;  ///< in units of unit_, subtracted from every time
  std::optional<std::int64_t> last_pts_;
  Moment last_shown_, end_;  ///< of the last frame, in its own time
  bool started_ = false;
  bool finished_ = false;
  std::string notice_;
};

}  // namespace rinkaku::sink
