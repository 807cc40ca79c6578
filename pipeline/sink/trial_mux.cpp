#include "pipeline/sink/trial_mux.h"

#include <algorithm>
#include <cstdint>
#include <memory>

#include "pipeline/ffmpeg/log.h"

namespace rinkaku::sink {
namespace {

constexpr int buffer_bytes = 4096;

// Swallows everything, but can be sought in as a file can.
struct Nowhere {
  std::int64_t position = 0;
  std::int64_t size = 0;
};

int swallow(void* opaque, std::uint8_t*, int bytes) {
  auto& nowhere = *static_cast<Nowhere*>(opaque);
  nowhere.position += bytes;
  nowhere.size = std::max(nowhere.size, nowhere.position);
  return bytes;
}

std::int64_t seek(void* opaque, std::int64_t offset, int whence) {
  auto& nowhere = *static_cast<Nowhere*>(opaque);
  if (whence == AVSEEK_SIZE) return nowhere.size;
  if (whence == SEEK_CUR) offset += nowhere.position;
  if (whence == SEEK_END) offset += nowhere.size;
  return nowhere.position = offset;
}

struct FreeIo {
  void operator()(AVIOContext* io) const {
    av_freep(&io->buffer);
    avio_context_free(&io);
  }
};

}  // namespace

std::string refusal(const AVOutputFormat& container, const AVStream& stream) {
  Nowhere nowhere;
  auto* buffer = static_cast<std::uint8_t*>(av_malloc(buffer_bytes));
  std::unique_ptr<AVIOContext, FreeIo> io(
      avio_alloc_context(buffer, buffer_bytes, 1, &nowhere, nullptr, swallow, seek));
  AVFormatContext* context = nullptr;
  if (!io || avformat_alloc_output_context2(&context, &container, nullptr, "") < 0) return "out of memory";
  ffmpeg::OutputPtr muxer(context);
  const ffmpeg::LogListener listener(context);
  context->pb = io.get();
  context->strict_std_compliance = FF_COMPLIANCE_UNOFFICIAL;
  AVStream* copy = avformat_new_stream(context, nullptr);
  if (!copy || avcodec_parameters_copy(copy->codecpar, stream.codecpar) < 0) return "out of memory";
  copy->time_base = stream.time_base;
  copy->avg_frame_rate = stream.avg_frame_rate;
  copy->sample_aspect_ratio = stream.sample_aspect_ratio;
  copy->disposition = stream.disposition;
  av_dict_copy(&copy->metadata, stream.metadata, 0);
  const int code = avformat_write_header(context, nullptr);
  return code < 0 ? complaint(listener, code) : std::string();
}

}  // namespace rinkaku::sink
