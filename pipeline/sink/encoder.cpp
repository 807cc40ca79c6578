#include "pipeline/sink/encoder.h"

#include <algorithm>
#include <cmath>
#include <string_view>

extern "C" {
#include <libavutil/opt.h>
}

#include "pipeline/ffmpeg/formats.h"
#include "pipeline/ffmpeg/frames.h"
#include "pipeline/frame/error.h"

namespace rinkaku::sink {
namespace {

// Longer than any encoder looks ahead.
constexpr std::size_t most_remembered = 1024;

AVRational encoder_rate(const AVCodec& codec, const Incoming& incoming) {
  AVRational rate = ffmpeg::to_av(incoming.frame_rate);
  if (rate.num <= 0) {
    const double ticks = 1 / incoming.time_base.value();
    rate = ticks >= 1 && ticks <= 240 ? av_inv_q(ffmpeg::to_av(incoming.time_base)) : AVRational{25, 1};
  }
  // The finest clock of MPEG-4's headers, and of several others.
  av_reduce(&rate.num, &rate.den, rate.num, rate.den, 65535);
  if (codec.supported_framerates)
    rate = codec.supported_framerates[av_find_nearest_q_idx(rate, codec.supported_framerates)];
  return rate;
}

}  // namespace

Encoder::Encoder(const AVCodec& codec, const AVOutputFormat* container, const Options& options,
                 const Incoming& incoming)
    : name_(options.path), format_(choose_encoder_format(codec, incoming.format)) {
  context_.reset(avcodec_alloc_context3(&codec));
  if (!context_) throw runtime_failure(name_, "out of memory");
  listener_.emplace(context_.get());
  AVCodecContext& c = *context_;
  c.width = incoming.format.width_px;
  c.height = incoming.format.height_px;
  c.pix_fmt = format_.label;
  c.sample_aspect_ratio = ffmpeg::to_av(incoming.format.sample_aspect);
  ffmpeg::set_colour(c, format_.picture.colour);
  c.framerate = encoder_rate(codec, incoming);
  c.time_base = av_inv_q(c.framerate);
  c.thread_count = options.threads;
  c.strict_std_compliance = FF_COMPLIANCE_UNOFFICIAL;
  set_quality(c, options.bit_rate);
  if (options.recording) set_for_recording(c);
  if (container && container->flags & AVFMT_GLOBALHEADER) c.flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  // AVI has no presentation times, so pictures must come in their order.
  if (container && std::string_view(container->name) == "avi") c.max_b_frames = 0;
  const int code = avcodec_open2(&c, &codec, nullptr);
  if (code < 0) {
    throw input_error(name_,
                      std::string("the encoder ") + codec.name + " refuses " + std::to_string(c.width) + "x" +
                          std::to_string(c.height) + " " + format_.picture.pixels.name + ": " +
                          complaint(*listener_, code),
                      "choose another codec, for instance ffv1 in .mkv");
  }
  if (!(format_.picture == incoming.format)) converter_.emplace(format_.picture);
}

void Encoder::check(int code) const {
  if (code >= 0) return;
  throw runtime_failure(
      name_, std::string("the encoder ") + context_->codec->name + " failed: " + complaint(*listener_, code));
}

void Encoder::send(const Frame& frame, std::int64_t pts, std::int64_t duration) {
  const double time_s = frame.time_s();
  Sent sent{0, pts, duration, frame.number};
  if (sent_.empty()) {
    first_time_s_ = time_s;
    first_pts_ = pts;
  } else {
    const auto nearest = std::llround((time_s - first_time_s_) * av_q2d(context_->framerate));
    sent.encoder_pts = std::max<std::int64_t>(nearest, sent_.back().encoder_pts + 1);
    ticks_per_frame_ = static_cast<double>(pts - first_pts_) / static_cast<double>(sent.encoder_pts);
  }
  ffmpeg::FramePtr picture = ffmpeg::wrap(frame);
  if (converter_) {
    Frame converted = converter_->convert(*picture);
    converted.interlaced = frame.interlaced;
    converted.top_field_first = frame.top_field_first;
    picture = ffmpeg::wrap(converted);
  }
  picture->format = format_.label;
  picture->pts = sent.encoder_pts;
  if (context_->flags & AV_CODEC_FLAG_QSCALE) picture->quality = context_->global_quality;
  sent_.push_back(sent);
  if (sent_.size() > most_remembered) sent_.pop_front();
  check(avcodec_send_frame(context_.get(), picture.get()));
}

void Encoder::flush() {
  const int code = avcodec_send_frame(context_.get(), nullptr);
  if (code != AVERROR_EOF) check(code);
}

const Encoder::Sent* Encoder::find(std::int64_t encoder_pts) const {
  const auto found = std::lower_bound(sent_.begin(), sent_.end(), encoder_pts,
                                      [](const Sent& s, std::int64_t pts) { return s.encoder_pts < pts; });
  return found != sent_.end() && found->encoder_pts == encoder_pts ? &*found : nullptr;
}

bool Encoder::receive(AVPacket& packet, std::int64_t* number) {
  const int code = avcodec_receive_packet(context_.get(), &packet);
  if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return false;
  check(code);
  const Sent* sent = find(packet.pts);
  if (!sent) throw runtime_failure(name_, std::string("the encoder ") + context_->codec->name + " lost a frame's time");
  const std::int64_t encoder_dts = packet.dts == AV_NOPTS_VALUE ? packet.pts : packet.dts;
  // Before the first frame there is no frame to take the decoding time of.
  const Sent* decoded_at = find(encoder_dts);
  packet.dts =
      decoded_at ? decoded_at->pts : first_pts_ + std::llround(static_cast<double>(encoder_dts) * ticks_per_frame_);
  if (last_dts_) packet.dts = std::max(packet.dts, *last_dts_ + 1);
  packet.dts = std::min(packet.dts, sent->pts);
  last_dts_ = packet.dts;
  packet.pts = sent->pts;
  packet.duration = sent->duration;
  if (number) *number = sent->number;
  return true;
}

}  // namespace rinkaku::sink
