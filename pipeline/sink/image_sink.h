#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/ffmpeg/number_pattern.h"
#include "pipeline/sink/encoder.h"
#include "pipeline/sink/sink.h"

namespace rinkaku::sink {

/// Still images, each under its frame's number; see sink::open(). Without a pattern it takes one frame.
class ImageSink final : public Sink {
 public:
  /// Throws Error (Input) if any file of the pattern exists already, unless Options::overwrite.
  ImageSink(const Options& options, const Incoming& incoming, const AVCodec& codec);
  /// Removes what was written if finish() was not called.
  ~ImageSink() override;

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
  std::vector<std::string> written_;
  bool finished_ = false;
};

}  // namespace rinkaku::sink
