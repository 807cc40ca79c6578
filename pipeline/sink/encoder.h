#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "pipeline/ffmpeg/converter.h"
#include "pipeline/ffmpeg/log.h"
#include "pipeline/sink/codec_choice.h"
#include "pipeline/sink/encoder_format.h"
#include "pipeline/sink/sink.h"

namespace rinkaku::sink {

/// One FFmpeg video encoder. Frames that it takes as they are are not copied.
///
/// The encoder itself counts time in frames of the average rate: rate control needs that, and MPEG-4 knows no finer
/// clock than 1/65535 s. Packets get the frames' exact times back when they come out.
class Encoder {
 public:
  /// Throws Error (Input) if the encoder does not take such frames.
  Encoder(const AVCodec& codec, const AVOutputFormat* container, const Options& options, const Incoming& incoming);

  const AVCodecContext& context() const { return *context_; }
  const std::string& notice() const { return format_.notice; }
  const ColourTags& colour() const { return format_.picture.colour; }
  /// Frames per second as set for the encoder.
  AVRational rate() const { return context_->framerate; }

  /// Encodes a frame shown at `pts` for `duration`, both in any unit that stays the same. `pts` must rise.
  void send(const Frame& frame, std::int64_t pts, std::int64_t duration);
  void flush();

  /// The next packet, its times in the unit of send(); empty if the encoder wants more frames or is at its end.
  /// `number` gets the number of the packet's frame.
  bool receive(AVPacket& packet, std::int64_t* number = nullptr);

 private:
  struct Sent {
    std::int64_t encoder_pts = 0;
    std::int64_t pts = 0;
    std::int64_t duration = 0;
    std::int64_t number = 0;
  };
  const Sent* find(std::int64_t encoder_pts) const;
  void check(int code) const;

  std::string name_;  ///< of the output, for messages
  EncoderFormat format_;
  ffmpeg::CodecPtr context_;
  std::optional<ffmpeg::LogListener> listener_;
  std::optional<ffmpeg::Converter> converter_;
  std::deque<Sent> sent_;
  double first_time_s_ = 0;
  std::int64_t first_pts_ = 0;
  std::optional<std::int64_t> last_dts_;
  double ticks_per_frame_ = 1;  ///< of send()'s pts
};

}  // namespace rinkaku::sink
