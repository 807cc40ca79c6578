#include "pipeline/sink/stream_copy.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <utility>

#include "pipeline/frame/error.h"
#include "pipeline/sink/trial_mux.h"

namespace rinkaku::sink {
namespace {

bool is_mov(const AVOutputFormat& format) {
  constexpr std::array<std::string_view, 6> names{"mp4", "mov", "ipod", "3gp", "3g2", "psp"};
  return std::find(names.begin(), names.end(), format.name) != names.end();
}

// What describes the old file and not what was filmed.
void drop_stale_tags(AVDictionary** tags, bool video) {
  constexpr std::array<const char*, 5> of_file{"major_brand", "minor_version", "compatible_brands", "encoder",
                                               "ENCODER"};
  constexpr std::array<const char*, 8> of_video{"rotate",
                                                "BPS",
                                                "DURATION",
                                                "NUMBER_OF_FRAMES",
                                                "NUMBER_OF_BYTES",
                                                "_STATISTICS_TAGS",
                                                "_STATISTICS_WRITING_APP",
                                                "_STATISTICS_WRITING_DATE_UTC"};
  for (const char* tag : of_file) av_dict_set(tags, tag, nullptr, 0);
  if (!video) return;
  for (const char* tag : of_video) av_dict_set(tags, tag, nullptr, 0);
}

std::string describe(const AVStream& stream) {
  const char* kind = av_get_media_type_string(stream.codecpar->codec_type);
  return "stream " + std::to_string(stream.index) + " (" + (kind ? kind : "unknown") + ", " +
         avcodec_get_name(stream.codecpar->codec_id) + ")";
}

// The muxer may know the codec by another tag than the old container.
std::uint32_t tag_for(const AVOutputFormat& format, const AVCodecParameters& parameters) {
  const std::uint32_t tag = parameters.codec_tag;
  if (!format.codec_tag || av_codec_get_id(format.codec_tag, tag) == parameters.codec_id) return tag;
  return 0;
}

}  // namespace

StreamCopy::StreamCopy(const std::string& path, AVFormatContext& muxer)
    : path_(path), muxer_(muxer), packet_(av_packet_alloc()) {
  AVFormatContext* context = avformat_alloc_context();
  if (!context || !packet_) throw runtime_failure(path, "out of memory");
  listener_ = std::make_unique<ffmpeg::LogListener>(context);
  ffmpeg::Dictionary options;
  options.set("protocol_whitelist", "file,crypto,data");
  int code = avformat_open_input(&context, ("file:" + path).c_str(), nullptr, options.address());
  if (code >= 0) {
    demuxer_.reset(context);
    code = avformat_find_stream_info(context, nullptr);
  }
  if (code < 0) throw input_error(path, "its sound can't be copied: " + complaint(*listener_, code), "check the file");
  video_ = av_find_best_stream(context, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  for (unsigned i = 0; i < context->nb_streams; ++i) {
    AVStream& stream = *context->streams[i];
    const bool is_video = static_cast<int>(i) == video_;
    // A discarded data stream is one that the demuxer has already read, as chapters for instance.
    const bool wanted = !is_video && stream.discard < AVDISCARD_ALL;
    target_.push_back(wanted && add_stream(stream) ? static_cast<int>(muxer.nb_streams) - 1 : -1);
    if (target_.back() < 0) stream.discard = AVDISCARD_ALL;
  }
  if (video_ >= 0) copy_video_side_data(*context->streams[video_], *muxer.streams[0]);
  copy_metadata();
  last_dts_.assign(muxer.nb_streams, AV_NOPTS_VALUE);
  next_time_.assign(context->nb_streams, AV_NOPTS_VALUE);
}

bool StreamCopy::add_stream(AVStream& from) {
  const AVOutputFormat& format = *muxer_.oformat;
  const auto leave_out = [&](const std::string& why) {
    notice_ += (notice_.empty() ? "" : "; ") + describe(from) + " is not copied: " + why;
    return false;
  };
  // The muxer makes its own time code from the metadata.
  if (from.codecpar->codec_tag == MKTAG('t', 'm', 'c', 'd') && is_mov(format)) return false;
  if (from.disposition & AV_DISPOSITION_ATTACHED_PIC && !is_mov(format)) {
    return leave_out(std::string(format.name) + " takes no cover picture");
  }
  AVCodecParameters* parameters = avcodec_parameters_alloc();
  if (!parameters || avcodec_parameters_copy(parameters, from.codecpar) < 0)
    throw runtime_failure(path_, "out of memory");
  parameters->codec_tag = tag_for(format, *parameters);
  const std::uint32_t old_tag = std::exchange(from.codecpar->codec_tag, parameters->codec_tag);
  avcodec_parameters_free(&parameters);
  const std::string why = refusal(format, from);
  // Such a container is pictures and nothing else, though its muxer would write anything.
  if (!why.empty() || format.flags & AVFMT_NOTIMESTAMPS) {
    from.codecpar->codec_tag = old_tag;
    return leave_out(std::string(format.name) + " does not take it");
  }
  AVStream* to = avformat_new_stream(&muxer_, nullptr);
  if (!to || avcodec_parameters_copy(to->codecpar, from.codecpar) < 0) throw runtime_failure(path_, "out of memory");
  to->time_base = from.time_base;
  to->avg_frame_rate = from.avg_frame_rate;
  to->sample_aspect_ratio = from.sample_aspect_ratio;
  to->disposition = from.disposition;
  av_dict_copy(&to->metadata, from.metadata, 0);
  drop_stale_tags(&to->metadata, false);
  for (int i = 0; i < from.nb_side_data; ++i) {
    const AVPacketSideData& data = from.side_data[i];
    if (auto* copy = av_stream_new_side_data(to, data.type, data.size)) std::memcpy(copy, data.data, data.size);
  }
  return true;
}

void StreamCopy::copy_video_side_data(const AVStream& from, AVStream& to) const {
  constexpr std::array<AVPacketSideDataType, 5> types{AV_PKT_DATA_DISPLAYMATRIX, AV_PKT_DATA_MASTERING_DISPLAY_METADATA,
                                                      AV_PKT_DATA_CONTENT_LIGHT_LEVEL, AV_PKT_DATA_STEREO3D,
                                                      AV_PKT_DATA_SPHERICAL};
  for (const AVPacketSideDataType type : types) {
    std::size_t size = 0;
    const std::uint8_t* data = av_stream_get_side_data(&from, type, &size);
    std::uint8_t* copy = data ? av_stream_new_side_data(&to, type, size) : nullptr;
    if (copy) std::memcpy(copy, data, size);
  }
  to.disposition = from.disposition & ~AV_DISPOSITION_ATTACHED_PIC;
  av_dict_copy(&to.metadata, from.metadata, 0);
  drop_stale_tags(&to.metadata, true);
}

void StreamCopy::copy_metadata() {
  av_dict_copy(&muxer_.metadata, demuxer_->metadata, 0);
  drop_stale_tags(&muxer_.metadata, false);
  const unsigned count = demuxer_->nb_chapters;
  if (count == 0) return;
  // The muxer frees these with itself.
  muxer_.chapters = static_cast<AVChapter**>(av_calloc(count, sizeof(AVChapter*)));
  for (unsigned i = 0; muxer_.chapters && i < count; ++i) {
    auto* chapter = static_cast<AVChapter*>(av_mallocz(sizeof(AVChapter)));
    if (!chapter) break;
    *chapter = *demuxer_->chapters[i];
    chapter->metadata = nullptr;
    av_dict_copy(&chapter->metadata, demuxer_->chapters[i]->metadata, 0);
    muxer_.chapters[muxer_.nb_chapters++] = chapter;
  }
}

Moment StreamCopy::arbitrary_start() const {
  const bool arbitrary = demuxer_->iformat->flags & AVFMT_TS_DISCONT && demuxer_->start_time != AV_NOPTS_VALUE;
  return {arbitrary ? demuxer_->start_time : 0, AV_TIME_BASE_Q};
}

void StreamCopy::start(Moment shift, Moment cut_before, bool cut) {
  shift_ = shift;
  cut_before_ = cut_before;
  cut_ = cut;
  for (unsigned i = 0; i < muxer_.nb_chapters; ++i) {
    AVChapter& chapter = *muxer_.chapters[i];
    const std::int64_t by = av_rescale_q(shift.value, shift.unit, chapter.time_base);
    chapter.start = std::max<std::int64_t>(0, chapter.start - by);
    chapter.end = std::max(chapter.start, chapter.end - by);
  }
}

Moment StreamCopy::time_of(const AVPacket& packet) const {
  const AVRational unit = demuxer_->streams[packet.stream_index]->time_base;
  return {packet.dts != AV_NOPTS_VALUE ? packet.dts : packet.pts, unit};
}

// Fetches the next packet to copy, or also one of the video: some demuxers return that even when it is discarded.
bool StreamCopy::read(bool video_too) {
  while (av_read_frame(demuxer_.get(), packet_.get()) >= 0) {
    AVPacket& packet = *packet_;
    const auto stream = static_cast<std::size_t>(packet.stream_index);
    // Streams may turn up late, as in MPEG transport streams.
    const bool known = stream < target_.size();
    if (known && (target_[stream] >= 0 || (video_too && packet.stream_index == video_))) {
      if (packet.dts == AV_NOPTS_VALUE) packet.dts = packet.pts;
      if (packet.dts == AV_NOPTS_VALUE) packet.dts = next_time_[stream] == AV_NOPTS_VALUE ? 0 : next_time_[stream];
      if (packet.pts == AV_NOPTS_VALUE && packet.stream_index != video_) packet.pts = packet.dts;
      next_time_[stream] = packet.dts + packet.duration;
      return true;
    }
    av_packet_unref(&packet);
  }
  return false;
}

int StreamCopy::write(AVPacket& packet) {
  const AVStream& from = *demuxer_->streams[packet.stream_index];
  if (cut_ && time_of(packet) < cut_before_ && !(from.disposition & AV_DISPOSITION_ATTACHED_PIC)) {
    av_packet_unref(&packet);
    return 0;
  }
  const int target = target_[static_cast<std::size_t>(packet.stream_index)];
  AVStream& to = *muxer_.streams[target];
  const std::int64_t by = av_rescale_q(shift_.value, shift_.unit, from.time_base);
  packet.pts -= by;
  packet.dts -= by;
  // AVI counts from 0: what decoders skip before that, as AAC's priming, would make the sound late.
  if (packet.pts + packet.duration <= 0 && std::string_view(muxer_.oformat->name) == "avi") {
    av_packet_unref(&packet);
    return 0;
  }
  av_packet_rescale_ts(&packet, from.time_base, to.time_base);
  std::int64_t& last = last_dts_[static_cast<std::size_t>(target)];
  // Muxers refuse times that do not rise, which rounding to another unit can make.
  if (last != AV_NOPTS_VALUE && packet.dts <= last && !(muxer_.oformat->flags & AVFMT_TS_NONSTRICT))
    packet.dts = last + 1;
  packet.pts = std::max(packet.pts, packet.dts);
  last = packet.dts;
  packet.stream_index = target;
  packet.pos = -1;
  return av_interleaved_write_frame(&muxer_, &packet);
}

int StreamCopy::write_until(Moment until) {
  while (waiting_ || read(false)) {
    waiting_ = true;
    if (!(time_of(*packet_) < until)) return 0;
    waiting_ = false;
    if (const int code = write(*packet_); code < 0) return code;
  }
  return 0;
}

int StreamCopy::finish(Moment last, Moment end) {
  if (std::all_of(target_.begin(), target_.end(), [](int target) { return target < 0; })) return 0;
  if (video_ >= 0) demuxer_->streams[video_]->discard = AVDISCARD_DEFAULT;
  // Whether the pictures go on shows only later: until then, what lies after their end is held back.
  std::deque<ffmpeg::PacketPtr> held;
  while (waiting_ || read(true)) {
    waiting_ = false;
    if (packet_->stream_index == video_) {
      const Moment shown{packet_->pts != AV_NOPTS_VALUE ? packet_->pts : packet_->dts, time_of(*packet_).unit};
      av_packet_unref(packet_.get());
      if (last < shown && !(shown < end)) return 0;
    } else if (time_of(*packet_) < end) {
      if (const int code = write(*packet_); code < 0) return code;
    } else {
      held.emplace_back(av_packet_alloc());
      if (!held.back()) throw runtime_failure(path_, "out of memory");
      av_packet_move_ref(held.back().get(), packet_.get());
    }
  }
  for (const auto& packet : held) {
    if (const int code = write(*packet); code < 0) return code;
  }
  return 0;
}

}  // namespace rinkaku::sink
