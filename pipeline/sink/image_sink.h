#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "pipeline/ffmpeg/number_pattern.h"
#include "pipeline/files/pending_file.h"
#include "pipeline/sink/encoder.h"
#include "pipeline/sink/sink.h"

namespace rinkaku::sink {

/// Still images, each under its frame's number; see sink::open(). Without a pattern it takes one frame. All lie under
/// hidden names until finish(), so that pictures of an earlier run stay whole till then.
class ImageSink final : public Sink {
 public:
  /// Throws Error (Input) if any file of the pattern exists already, unless Options::overwrite.
  ImageSink(const Options& options, const Incoming& incoming, const AVCodec& codec);

  void write(const Frame& frame) override;
  void finish() override;
  std::string notice() const override { return encoder_->notice(); }

 private:
  void drain();
  void write_file(const std::string& path, const AVPacket& packet);

  Options options_;
  std::string input_;
  std::optional<ffmpeg::NumberPattern> pattern_;
  std::unique_ptr<Encoder> encoder_;
  ffmpeg::PacketPtr packet_;
  std::int64_t frames_ = 0;
  std::deque<files::PendingFile> pending_;  ///< written; put in place by finish()
  bool finished_ = false;
};

}  // namespace rinkaku::sink
