#pragma once

#include <memory>
#include <optional>
#include <string>

#include "pipeline/ffmpeg/converter.h"
#include "pipeline/files/pending_file.h"
#include "pipeline/sink/encoder_format.h"
#include "pipeline/sink/sink.h"

namespace rinkaku::sink {

/// YUV4MPEG2, the uncompressed video that most programs read from a pipe: a line of text, then every frame's planes.
/// Written here and not by FFmpeg, whose muxer miscounts the chroma of deep pictures of odd width. Carries no times.
class Y4mSink final : public Sink {
 public:
  Y4mSink(const Options& options, const Incoming& incoming);
  ~Y4mSink() override;

  void write(const Frame& frame) override;
  void finish() override;
  std::string notice() const override { return notice_; }

 private:
  void write_header(const Frame& first);
  void check(int code) const;

  std::string path_;
  files::PendingFile file_;
  EncoderFormat format_;
  AVRational rate_;
  AVIOContext* io_ = nullptr;
  std::optional<ffmpeg::Converter> converter_;
  bool started_ = false;
  std::string notice_;
};

}  // namespace rinkaku::sink
