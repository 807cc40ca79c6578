#include "pipeline/source/video_source.h"

#include <algorithm>
#include <cmath>
#include <utility>

extern "C" {
#include <libavutil/display.h>
#include <libavutil/pixdesc.h>
}

#include "pipeline/ffmpeg/formats.h"
#include "pipeline/ffmpeg/frames.h"
#include "pipeline/frame/error.h"
#include "pipeline/source/container_facts.h"

namespace rinkaku::source {
namespace {

// A demuxer or decoder that fails so often in a row won't recover.
constexpr int most_errors_in_a_row = 1000;

bool palette_is_opaque(const AVFrame& picture) {
  const auto* entries = reinterpret_cast<const std::uint32_t*>(picture.data[1]);
  return std::all_of(entries, entries + 256, [](std::uint32_t argb) { return argb >> 24 == 255; });
}

std::string count_of(std::int64_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

}  // namespace

VideoSource::VideoSource(Input input, const OpenOptions& options)
    : input_(std::move(input)),
      demuxer_(open_demuxer(input_, options)),
      decoder_(open_decoder(input_, demuxer_, options)),
      decoder_errors_(decoder_.get()),
      packet_(av_packet_alloc()) {
  if (!packet_) throw runtime_failure(input_.name, "out of memory");
  demuxer_.listener->clear();
  first_ = decode();
  if (!first_) {
    const std::string why = damage_.packets > 0
                                ? "all " + count_of(damage_.packets, "packet is", "packets are") + " damaged"
                                : "the file ends before its first picture";
    throw input_error(input_.name, "no picture of it can be decoded: " + why, "check that the file is whole");
  }
  describe(*first_);
  if (options.convert_to) {
    description_.format = *options.convert_to;
    description_.notice.clear();
    always_convert_ = true;
  }
}

void VideoSource::describe(const AVFrame& first) {
  stored_format_ = static_cast<AVPixelFormat>(first.format);
  const bool opaque = stored_format_ == AV_PIX_FMT_PAL8 && palette_is_opaque(first);
  const AVPixelFormat format = ffmpeg::nearest_addressable(stored_format_, opaque);
  if (format == AV_PIX_FMT_NONE) {
    throw input_error(input_.name, "its pixel format is unknown", "convert it to another pixel format");
  }
  description_.name = input_.name;
  stored_width_px_ = first.width;
  stored_height_px_ = first.height;
  description_.format.width_px = first.width;
  description_.format.height_px = first.height;
  description_.format.pixels = ffmpeg::to_pixel_format(format);
  description_.format.colour = ffmpeg::colour_of(first);
  always_convert_ = format != stored_format_ && !ffmpeg::is_j(stored_format_);
  if (always_convert_) {
    description_.notice = std::string("pictures are converted from ") + av_get_pix_fmt_name(stored_format_) + " to " +
                          description_.format.pixels.name;
  }
  AVFormatContext& context = *demuxer_.context;
  description_.format.sample_aspect =
      ffmpeg::from_av(av_guess_sample_aspect_ratio(&context, &stream(), const_cast<AVFrame*>(&first)));
  if (description_.format.sample_aspect.num == 0) description_.format.sample_aspect = {0, 1};
  read_container(first);
}

void VideoSource::read_container(const AVFrame& first) {
  AVFormatContext& context = *demuxer_.context;
  description_.time_base = ffmpeg::from_av(stream().time_base);
  if (first.best_effort_timestamp != AV_NOPTS_VALUE) description_.first_pts = first.best_effort_timestamp;
  description_.frame_rate = frame_rate(context, stream());
  description_.variable_frame_rate = !input_.image_sequence && variable_frame_rate(context, stream());
  description_.frame_count =
      input_.image_sequence ? input_.pictures : frame_count(context, stream(), description_.frame_rate);
  description_.rotation_deg = rotation_deg(stream(), first);
  const AVFieldOrder order = stream().codecpar->field_order;
  container_interlaced_ = order != AV_FIELD_UNKNOWN && order != AV_FIELD_PROGRESSIVE;
  container_top_first_ = order == AV_FIELD_TT || order == AV_FIELD_BT;
  if (description_.frame_rate.num > 0) {
    const double ticks = 1 / (description_.frame_rate.value() * description_.time_base.value());
    step_ = std::max<std::int64_t>(1, std::llround(ticks));
  }
}

std::optional<Frame> VideoSource::next() {
  ffmpeg::FramePtr picture = first_ ? std::move(first_) : decode();
  if (!picture) return {};
  return deliver(std::move(picture));
}

ffmpeg::FramePtr VideoSource::decode() {
  ffmpeg::FramePtr picture(av_frame_alloc());
  if (!picture) throw runtime_failure(input_.name, "out of memory");
  while (errors_in_a_row_ < most_errors_in_a_row) {
    const int code = avcodec_receive_frame(decoder_.get(), picture.get());
    if (code >= 0) {
      errors_in_a_row_ = 0;
      if (picture->flags & AV_FRAME_FLAG_CORRUPT || picture->decode_error_flags) ++damage_.pictures;
      return picture;
    }
    if (code == AVERROR_EOF) return {};
    if (code == AVERROR(ENOMEM)) throw runtime_failure(input_.name, "out of memory while decoding");
    if (code == AVERROR(EAGAIN)) {
      if (!feed()) return {};
    } else {
      ++errors_in_a_row_;
      ++damage_.packets;
    }
  }
  damage_.cut = "nothing more can be decoded";
  return {};
}

// Gives the decoder one more packet, or tells it that there are no more.
bool VideoSource::feed() {
  if (draining_) return false;
  while (errors_in_a_row_ < most_errors_in_a_row) {
    const bool all_read = input_.image_sequence && packets_read_ >= input_.pictures;
    const int code = all_read ? AVERROR_EOF : av_read_frame(demuxer_.context.get(), packet_.get());
    if (code == AVERROR_INVALIDDATA) {
      ++errors_in_a_row_;
      ++damage_.packets;
      continue;
    }
    if (code < 0) {
      end_of_file(code);
      draining_ = true;
      avcodec_send_packet(decoder_.get(), nullptr);
      return true;
    }
    if (packet_->stream_index != demuxer_.video_stream) {
      av_packet_unref(packet_.get());
      continue;
    }
    ++packets_read_;
    const std::int64_t time = packet_->pts != AV_NOPTS_VALUE ? packet_->pts : packet_->dts;
    if (time != AV_NOPTS_VALUE) last_end_ = std::max(last_end_, time + packet_->duration);
    const int sent = avcodec_send_packet(decoder_.get(), packet_.get());
    av_packet_unref(packet_.get());
    if (sent == AVERROR(ENOMEM)) throw runtime_failure(input_.name, "out of memory while decoding");
    if (sent < 0) {
      ++errors_in_a_row_;
      ++damage_.packets;
      continue;
    }
    return true;
  }
  return false;
}

void VideoSource::end_of_file(int code) {
  if (code != AVERROR_EOF) {
    damage_.cut = "reading stopped: " + complaint(*demuxer_.listener, code);
  } else if (demuxer_.listener->errors() > 0) {
    damage_.cut = demuxer_.listener->last();
  } else if (!input_.image_sequence) {
    const double missing_s = missing_seconds(*demuxer_.context, stream(), last_end_);
    if (missing_s > 0) damage_.cut = "the file ends " + std::to_string(missing_s).substr(0, 5) + " s early";
  }
}

Frame VideoSource::deliver(ffmpeg::FramePtr picture) {
  const PictureFormat& format = description_.format;
  const bool alike =
      picture->width == stored_width_px_ && picture->height == stored_height_px_ && picture->format == stored_format_;
  if (!alike) ++damage_.resized;
  Frame header;
  stamp(header, *picture);
  Frame frame;
  if (alike && !always_convert_) {
    frame = ffmpeg::wrap(std::move(picture), format);
  } else {
    if (!converter_) converter_.emplace(format);
    frame = converter_->convert(*picture);
  }
  frame.number = header.number;
  frame.pts = header.pts;
  frame.duration = header.duration;
  frame.time_base = header.time_base;
  frame.key = header.key;
  frame.interlaced = header.interlaced;
  frame.top_field_first = header.top_field_first;
  return frame;
}

void VideoSource::stamp(Frame& frame, const AVFrame& picture) {
  frame.number = next_number_++;
  frame.time_base = description_.time_base;
  frame.duration = picture.pkt_duration > 0 ? picture.pkt_duration : step_;
  const bool first = frame.number == 0;
  frame.pts = picture.best_effort_timestamp;
  if (frame.pts == AV_NOPTS_VALUE) {
    frame.pts = first ? description_.first_pts : last_pts_ + step_;
    // A still image has no time to miss.
    if (!first) ++damage_.times;
  } else if (!first && frame.pts <= last_pts_) {
    frame.pts = last_pts_ + 1;
    ++damage_.times;
  }
  last_pts_ = frame.pts;
  frame.key = picture.key_frame != 0;
  frame.interlaced = picture.interlaced_frame || container_interlaced_;
  frame.top_field_first = picture.interlaced_frame ? picture.top_field_first != 0 : container_top_first_;
}

std::string VideoSource::damage() const {
  std::string line;
  const auto add = [&line](const std::string& part) { line += (line.empty() ? "" : "; ") + part; };
  if (damage_.packets > 0) add(count_of(damage_.packets, "damaged packet was", "damaged packets were") + " left out");
  if (damage_.pictures > 0) add(count_of(damage_.pictures, "picture", "pictures") + " decoded with errors");
  if (line.empty() && decoder_errors_.errors() > 0) add("the decoder reports errors: " + decoder_errors_.last());
  if (damage_.resized > 0) {
    add(count_of(damage_.resized, "picture", "pictures") +
        " of another size or pixel format converted to that of the first");
  }
  if (damage_.times > 0)
    add(count_of(damage_.times, "missing or falling time", "missing or falling times") + " mended");
  if (!damage_.cut.empty()) add(damage_.cut);
  if (draining_ && !input_.missing.empty()) add(input_.missing);
  return line.empty() ? line : input_.name + ": " + line;
}

}  // namespace rinkaku::source
