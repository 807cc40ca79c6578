#include "pipeline/source/container_facts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

extern "C" {
#include <libavutil/display.h>
}

#include "pipeline/ffmpeg/formats.h"

namespace rinkaku::source {
namespace {

// Containers whose index, once opened, lists every frame.
bool indexes_all_frames(const AVFormatContext& container) {
  const std::string_view name = container.iformat->name;
  return name == "avi" || name.starts_with("mov,");
}

const std::int32_t* display_matrix(const AVStream& stream, const AVFrame& first) {
  if (const auto* matrix = av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr)) {
    return reinterpret_cast<const std::int32_t*>(matrix);
  }
  const AVFrameSideData* data = av_frame_get_side_data(&first, AV_FRAME_DATA_DISPLAYMATRIX);
  return data ? reinterpret_cast<const std::int32_t*>(data->data) : nullptr;
}

}  // namespace

Rational frame_rate(AVFormatContext& container, AVStream& stream) {
  AVRational rate = stream.avg_frame_rate;
  if (rate.num <= 0 || rate.den <= 0) rate = av_guess_frame_rate(&container, &stream, nullptr);
  return rate.num > 0 && rate.den > 0 ? ffmpeg::from_av(rate) : Rational{0, 1};
}

bool variable_frame_rate(const AVFormatContext& container, AVStream& stream) {
  const int entries = avformat_index_get_entries_count(&stream);
  if (indexes_all_frames(container) && entries > 2) {
    std::int64_t shortest = std::numeric_limits<std::int64_t>::max(), longest = 0;
    std::int64_t last = avformat_index_get_entry(&stream, 0)->timestamp;
    for (int i = 1; i < entries; ++i) {
      const std::int64_t time = avformat_index_get_entry(&stream, i)->timestamp;
      shortest = std::min(shortest, time - last);
      longest = std::max(longest, time - last);
      last = time;
    }
    // Even times in a coarse unit are rounded to one tick more or less.
    return longest - shortest > 1 || (longest != shortest && shortest < 20);
  }
  const double average = av_q2d(stream.avg_frame_rate), base = av_q2d(stream.r_frame_rate);
  if (!(average > 0) || !(base > 0)) return false;
  // The base rate of interlaced video counts fields.
  const double ratio = base / average;
  return std::abs(ratio - 1) > 0.02 && std::abs(ratio - 2) > 0.002;
}

std::int64_t frame_count(const AVFormatContext& container, AVStream& stream, Rational rate) {
  const int entries = avformat_index_get_entries_count(&stream);
  if (indexes_all_frames(container) && entries > 0) return entries;
  if (stream.nb_frames > 0) return stream.nb_frames;
  double seconds = 0;
  if (stream.duration > 0) {
    seconds = static_cast<double>(stream.duration) * av_q2d(stream.time_base);
  } else if (container.duration > 0) {
    seconds = static_cast<double>(container.duration) / AV_TIME_BASE;
  }
  return std::llround(seconds * rate.value());
}

int rotation_deg(const AVStream& stream, const AVFrame& first) {
  const std::int32_t* matrix = display_matrix(stream, first);
  if (!matrix) return 0;
  const double angle = av_display_rotation_get(matrix);
  if (std::isnan(angle)) return 0;
  return static_cast<int>((std::lround(angle) % 360 + 360) % 360);
}

double missing_seconds(const AVFormatContext& container, const AVStream& stream, std::int64_t end) {
  // Elsewhere the duration is a guess, or that of the longest stream.
  if (!indexes_all_frames(container) || stream.duration <= 0) return 0;
  const std::int64_t start = stream.start_time != AV_NOPTS_VALUE ? stream.start_time : 0;
  const double missing = static_cast<double>(start + stream.duration - end) * av_q2d(stream.time_base);
  // Edit lists and the last frame's unknown length make small differences.
  return missing > 0.5 ? missing : 0;
}

}  // namespace rinkaku::source
