#include "pipeline/source/frame_memory.h"

#include <array>
#include <cstdlib>
#include <mutex>

#include <sys/mman.h>

extern "C" {
#include <libavutil/imgutils.h>
#include <libavutil/pixdesc.h>
}

namespace rinkaku::source {
namespace {

constexpr std::size_t large_page = std::size_t{2} << 20;
// Smaller pictures would leave too much of a page empty.
constexpr std::size_t least_size = large_page / 2;
constexpr std::size_t plane_alignment = 64;

std::size_t rounded_up(std::size_t size, std::size_t to) { return (size + to - 1) / to * to; }

AVBufferRef* allocate(std::size_t size) {
  auto* memory = static_cast<std::uint8_t*>(std::aligned_alloc(large_page, rounded_up(size, large_page)));
  if (!memory) return nullptr;
  madvise(memory, rounded_up(size, large_page), MADV_HUGEPAGE);  // refused, they are small pages
  AVBufferRef* buffer = av_buffer_create(
      memory, size, [](void*, std::uint8_t* data) { std::free(data); }, nullptr, 0);
  if (!buffer) std::free(memory);
  return buffer;
}

// Where the planes of a picture lie in one buffer.
struct Layout {
  std::array<int, 4> stride_bytes{};
  std::array<std::size_t, 4> offset{};
  std::size_t size = 0;
};

// Strides and heights as the decoder wants them (avcodec_align_dimensions2()); size 0 if it can't be laid out.
Layout layout_of(AVCodecContext& decoder, const AVFrame& frame) {
  int width = frame.width, height = frame.height;
  int alignment[AV_NUM_DATA_POINTERS];
  avcodec_align_dimensions2(&decoder, &width, &height, alignment);
  const auto format = static_cast<AVPixelFormat>(frame.format);
  Layout layout;
  for (bool aligned = false; !aligned; width += width & -width) {
    if (av_image_fill_linesizes(layout.stride_bytes.data(), format, width) < 0) return {};
    aligned = true;
    for (int p = 0; p < 4; ++p) aligned = aligned && layout.stride_bytes[p] % alignment[p] == 0;
  }
  const std::array<std::ptrdiff_t, 4> strides{layout.stride_bytes[0], layout.stride_bytes[1], layout.stride_bytes[2],
                                              layout.stride_bytes[3]};
  std::array<std::size_t, 4> sizes{};
  if (av_image_fill_plane_sizes(sizes.data(), format, height, strides.data()) < 0) return {};
  for (int p = 0; p < 4; ++p) {
    layout.offset[p] = layout.size;
    // Decoders read and write whole vectors past a plane's end.
    if (sizes[p] > 0) layout.size += rounded_up(sizes[p] + 2 * plane_alignment, plane_alignment);
  }
  return layout;
}

}  // namespace

// Pictures of one size; what is on its way in others stays valid.
struct FrameMemory::Pool {
  ~Pool() { av_buffer_pool_uninit(&buffers); }
  AVBufferRef* take(std::size_t wanted) {
    const std::lock_guard lock(mutex);
    if (wanted != size) {
      av_buffer_pool_uninit(&buffers);
      buffers = av_buffer_pool_init(wanted, allocate);
      size = wanted;
    }
    return buffers ? av_buffer_pool_get(buffers) : nullptr;
  }

  std::mutex mutex;  // decoding threads ask at once
  AVBufferPool* buffers = nullptr;
  std::size_t size = 0;
};

FrameMemory::FrameMemory() : pool_(std::make_unique<Pool>()) {}
FrameMemory::~FrameMemory() = default;

void FrameMemory::serve(AVCodecContext& decoder) {
  decoder.opaque = this;
  decoder.get_buffer2 = get_buffer;
#if LIBAVCODEC_VERSION_MAJOR < 60
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
  decoder.thread_safe_callbacks = 1;  // later versions take that for granted
#pragma GCC diagnostic pop
#endif
}

int FrameMemory::get_buffer(AVCodecContext* decoder, AVFrame* frame, int flags) {
  const AVPixFmtDescriptor* format = av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame->format));
  const bool plain = decoder->codec_type == AVMEDIA_TYPE_VIDEO && (decoder->codec->capabilities & AV_CODEC_CAP_DR1) &&
                     format && !(format->flags & (AV_PIX_FMT_FLAG_PAL | AV_PIX_FMT_FLAG_HWACCEL));
  const Layout layout = plain ? layout_of(*decoder, *frame) : Layout{};
  if (layout.size < least_size) return avcodec_default_get_buffer2(decoder, frame, flags);
  frame->buf[0] = static_cast<FrameMemory*>(decoder->opaque)->pool_->take(layout.size);
  if (!frame->buf[0]) return AVERROR(ENOMEM);
  for (int p = 0; p < 4; ++p) {
    frame->linesize[p] = layout.stride_bytes[p];
    frame->data[p] = layout.stride_bytes[p] > 0 ? frame->buf[0]->data + layout.offset[p] : nullptr;
  }
  frame->extended_data = frame->data;
  return 0;
}

}  // namespace rinkaku::source
