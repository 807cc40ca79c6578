#include "pipeline/sink/video_sink.h"

#include <cmath>
#include <filesystem>
#include <string_view>

extern "C" {
#include <libavutil/display.h>
#include <libavutil/opt.h>
}

#include "pipeline/ffmpeg/formats.h"
#include "pipeline/frame/error.h"
#include "pipeline/sink/output_url.h"
#include "pipeline/sink/trial_mux.h"

namespace rinkaku::sink {
namespace {

constexpr std::int64_t piece_us = 250'000;  // of a recording

bool is_named(const AVOutputFormat& container, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    if (name == container.name) return true;
  }
  return false;
}

// Image sequences, named by a pattern, hold pictures only.
bool holds_streams(const std::string& path) {
  return !path.empty() && (path.find_first_of("%*?[") == std::string::npos || std::filesystem::exists(path));
}

// A display matrix whose 2x2 part has a negative determinant.
bool mirrors_picture(const std::int32_t* matrix) {
  const auto entry = [matrix](int i) { return static_cast<double>(matrix[i]); };
  return entry(0) * entry(4) - entry(1) * entry(3) < 0;
}

}  // namespace

VideoSink::VideoSink(const Options& options, const Incoming& incoming)
    : options_(options),
      incoming_(incoming),
      choice_(choose_video_codec(options)),
      avi_(is_named(*choice_.container, {"avi"})),
      file_(options.path, options.overwrite, incoming.copy_streams_from,
            options.recording ? files::Appears::AtOnce : files::Appears::WhenWhole),
      packet_(av_packet_alloc()) {
  check_rates();
  encoder_ = std::make_unique<Encoder>(*choice_.encoder, choice_.container, options_, incoming_);
  AVFormatContext* context = nullptr;
  if (!packet_ || avformat_alloc_output_context2(&context, choice_.container, nullptr, output_url(file_).c_str()) < 0) {
    throw runtime_failure(options_.path, "out of memory");
  }
  muxer_.reset(context);
  listener_ = std::make_unique<ffmpeg::LogListener>(context);
  context->strict_std_compliance = FF_COMPLIANCE_UNOFFICIAL;
  if (options_.recording) write_in_small_pieces();
  add_video_stream();
  // Where MP4 and MOV start is counted in this unit, usually 1/1000 s; other muxers have no such option.
  if (unit_.num == 1 && unit_.den > 1000) av_opt_set_int(context->priv_data, "movie_timescale", unit_.den, 0);
  say(encoder_->notice());
  say_what_is_lost();
  if (holds_streams(incoming_.copy_streams_from)) {
    copy_ = std::make_unique<StreamCopy>(incoming_.copy_streams_from, *context);
    say(copy_->notice());
  }
  add_rotation();
  const std::string refused = refusal(*choice_.container, *context->streams[0]);
  if (!refused.empty()) {
    throw input_error(options_.path,
                      std::string("the container ") + choice_.container->name + " does not take " +
                          choice_.encoder->name + ": " + refused,
                      "choose another codec, or a name ending in .mkv");
  }
  if (const int code = avio_open(&context->pb, output_url(file_).c_str(), AVIO_FLAG_WRITE); code < 0) {
    throw_write_error(options_.path, code, true);
  }
}

// Each piece can be decoded without what follows, and none waits in memory.
void VideoSink::write_in_small_pieces() {
  AVFormatContext& muxer = *muxer_;
  muxer.flags |= AVFMT_FLAG_FLUSH_PACKETS;
  if (is_named(*choice_.container, {"mp4", "mov", "ipod", "3gp", "3g2", "psp"})) {
    av_opt_set(muxer.priv_data, "movflags", "empty_moov+default_base_moof", 0);
    av_opt_set_int(muxer.priv_data, "frag_duration", piece_us, 0);
  } else if (is_named(*choice_.container, {"matroska", "webm"})) {
    av_opt_set_int(muxer.priv_data, "cluster_time_limit", piece_us / 1000, 0);
  }
}

VideoSink::~VideoSink() {
  encoder_.reset();
  close_io();
}

void VideoSink::close_io() {
  if (muxer_ && muxer_->pb) avio_closep(&muxer_->pb);
}

void VideoSink::say(const std::string& what) {
  if (!what.empty()) notice_ += (notice_.empty() ? "" : "; ") + what;
}

void VideoSink::check_rates() const {
  if (!avi_) return;
  const char* remedy = "write to a name ending in .mkv or .mp4";
  if (incoming_.frame_rate.num <= 0) throw input_error(options_.path, "AVI needs a known frame rate", remedy);
  const bool on_grid = av_cmp_q(av_inv_q(ffmpeg::to_av(incoming_.frame_rate)), ffmpeg::to_av(incoming_.time_base)) == 0;
  if (incoming_.variable_frame_rate && !on_grid) {
    throw input_error(options_.path, "AVI can't hold frames at uneven times", remedy);
  }
}

void VideoSink::add_video_stream() {
  AVStream* stream = avformat_new_stream(muxer_.get(), nullptr);
  if (!stream || avcodec_parameters_from_context(stream->codecpar, &encoder_->context()) < 0) {
    throw runtime_failure(options_.path, "out of memory");
  }
  const bool rate_known = incoming_.frame_rate.num > 0;
  unit_ = avi_ ? av_inv_q(ffmpeg::to_av(incoming_.frame_rate)) : ffmpeg::to_av(incoming_.time_base);
  stream->time_base = unit_;
  stream->avg_frame_rate = rate_known ? ffmpeg::to_av(incoming_.frame_rate) : encoder_->rate();
  stream->sample_aspect_ratio = ffmpeg::to_av(incoming_.format.sample_aspect);
}

void VideoSink::add_rotation() {
  // Copied from the input, and more than a rotation: it may also mirror.
  const auto* copied = reinterpret_cast<const std::int32_t*>(
      av_stream_get_side_data(muxer_->streams[0], AV_PKT_DATA_DISPLAYMATRIX, nullptr));
  const bool mirrors = copied && mirrors_picture(copied);
  if (incoming_.rotation_deg % 360 == 0 && !mirrors) return;
  if (!is_named(*choice_.container, {"mp4", "mov", "ipod", "3gp", "3g2", "psp"})) {
    const std::string name = choice_.container->name;
    say(mirrors ? name + " keeps no mirroring: the input is shown mirrored, this video won't be"
                : name + " keeps no rotation: show the video turned by " + std::to_string(incoming_.rotation_deg) +
                      " degrees anticlockwise");
    return;
  }
  if (copied) return;
  constexpr std::size_t bytes = 9 * sizeof(std::int32_t);
  auto* matrix =
      reinterpret_cast<std::int32_t*>(av_stream_new_side_data(muxer_->streams[0], AV_PKT_DATA_DISPLAYMATRIX, bytes));
  if (!matrix) throw runtime_failure(options_.path, "out of memory");
  // FFmpeg sets clockwise turns and tells anticlockwise ones.
  av_display_rotation_set(matrix, -incoming_.rotation_deg);
}

void VideoSink::say_what_is_lost() {
  const AVOutputFormat& container = *choice_.container;
  if (incoming_.variable_frame_rate && container.flags & AVFMT_NOTIMESTAMPS) {
    say(std::string(container.name) + " carries no times: frames are shown at an even rate");
  }
  if (is_named(container, {"rawvideo"})) return;
  const ColourTags& colour = encoder_->colour();
  const bool tagged = colour.primaries != 2 || colour.transfer != 2 || colour.matrix != 2;
  const bool full = colour.range == ColourTags::Range::Full && encoder_->context().pix_fmt != AV_PIX_FMT_GRAY8;
  const bool in_codec =
      encoder_->context().codec_id == AV_CODEC_ID_H264 || encoder_->context().codec_id == AV_CODEC_ID_HEVC;
  const bool in_container = is_named(container, {"matroska", "webm", "mp4", "mov", "ipod", "nut"});
  if ((tagged || full) && !in_codec && !in_container) say(std::string(container.name) + " keeps no colour tags");
}

std::int64_t VideoSink::output_pts(const Frame& frame) const {
  const AVRational from = ffmpeg::to_av(frame.time_base);
  const std::int64_t pts = av_rescale_q(frame.pts, from, unit_);
  if (avi_) {
    const double exact = frame.time_s() / av_q2d(unit_);
    if (std::abs(exact - static_cast<double>(pts)) > 0.25 || (last_pts_ && pts - shift_ <= *last_pts_)) {
      throw input_error(options_.path, "AVI can't hold frames at uneven times",
                        "write to a name ending in .mkv or .mp4");
    }
  }
  return pts - shift_;
}

void VideoSink::start(const Frame& first) {
  if (first.interlaced) {
    muxer_->streams[0]->codecpar->field_order = first.top_field_first ? AV_FIELD_TT : AV_FIELD_BB;
  }
  const Moment shown{first.pts, ffmpeg::to_av(first.time_base)};
  // A part of a video starts at 0; a whole one keeps its times.
  const bool cut = first.number > 0;
  const Moment shift = cut ? shown : copy_ ? copy_->arbitrary_start() : Moment{};
  shift_ = av_rescale_q(shift.value, shift.unit, unit_);
  if (copy_) copy_->start(shift, shown, cut);
  check(avformat_write_header(muxer_.get(), nullptr));
  started_ = true;
}

void VideoSink::write(const Frame& frame) {
  if (!started_) start(frame);
  const std::int64_t pts = output_pts(frame);
  if (last_pts_ && pts <= *last_pts_) throw runtime_failure(options_.path, "the frames' times do not rise");
  last_pts_ = pts;
  const AVRational frame_unit = ffmpeg::to_av(frame.time_base);
  last_shown_ = {frame.pts, frame_unit};
  end_ = {frame.pts + frame.duration, frame_unit};
  if (copy_) check(copy_->write_until(last_shown_));
  encoder_->send(frame, pts, av_rescale_q(frame.duration, frame_unit, unit_));
  drain();
}

void VideoSink::drain() {
  while (encoder_->receive(*packet_)) {
    packet_->stream_index = 0;
    av_packet_rescale_ts(packet_.get(), unit_, muxer_->streams[0]->time_base);
    check(av_interleaved_write_frame(muxer_.get(), packet_.get()));
  }
}

void VideoSink::check(int code) const {
  if (code >= 0) return;
  if (listener_->errors() > 0 && code == AVERROR(EINVAL)) {
    throw runtime_failure(options_.path, "can't be written: " + listener_->last());
  }
  throw_write_error(options_.path, code);
}

void VideoSink::finish() {
  if (finished_) return;
  finished_ = true;
  if (!started_) throw runtime_failure(options_.path, "no frame came, so nothing is written");
  encoder_->flush();
  drain();
  if (copy_) check(copy_->finish(last_shown_, end_));
  check(av_write_trailer(muxer_.get()));
  check(avio_closep(&muxer_->pb));
  file_.commit();
}

}  // namespace rinkaku::sink
