#include "pipeline/ffmpeg/frames.h"

#include <cstdlib>
#include <utility>

#include "pipeline/ffmpeg/formats.h"
#include "pipeline/frame/error.h"

namespace rinkaku::ffmpeg {
namespace {

void release(void* keeper, std::uint8_t*) { delete static_cast<std::shared_ptr<void>*>(keeper); }

// FFmpeg asks which buffer a plane lies in, so every plane gets a reference of its own.
AVBufferRef* reference(const Plane& plane, const std::shared_ptr<void>& storage) {
  const std::ptrdiff_t span = std::abs(plane.stride_bytes) * (plane.rows - 1);
  std::uint8_t* first = plane.stride_bytes < 0 ? plane.data - span : plane.data;
  auto keeper = std::make_unique<std::shared_ptr<void>>(storage);
  AVBufferRef* buffer = av_buffer_create(first, static_cast<std::size_t>(span + plane.row_bytes), release, keeper.get(),
                                         AV_BUFFER_FLAG_READONLY);
  if (buffer) keeper.release();
  return buffer;
}

}  // namespace

Frame wrap(FramePtr decoded, const PictureFormat& format) {
  Frame frame;
  frame.format = format;
  set_plane_sizes(frame);
  for (int p = 0; p < format.pixels.planes; ++p) {
    frame.planes[static_cast<std::size_t>(p)].data = decoded->data[p];
    frame.planes[static_cast<std::size_t>(p)].stride_bytes = decoded->linesize[p];
  }
  frame.storage = std::shared_ptr<void>(decoded.release(), [](void* p) { Free{}(static_cast<AVFrame*>(p)); });
  frame.let_go = [](const void* picture) {
    return av_frame_is_writable(const_cast<AVFrame*>(static_cast<const AVFrame*>(picture))) > 0;
  };
  return frame;
}

FramePtr wrap(const Frame& frame) {
  FramePtr out(av_frame_alloc());
  if (!out) throw runtime_failure("", "out of memory for a frame");
  out->format = to_av(frame.format.pixels);
  out->width = frame.format.width_px;
  out->height = frame.format.height_px;
  out->sample_aspect_ratio = to_av(frame.format.sample_aspect);
  out->interlaced_frame = frame.interlaced;
  out->top_field_first = frame.top_field_first;
  set_colour(*out, frame.format.colour);
  for (int p = 0; p < frame.format.pixels.planes; ++p) {
    const Plane& plane = frame.planes[static_cast<std::size_t>(p)];
    out->data[p] = plane.data;
    out->linesize[p] = static_cast<int>(plane.stride_bytes);
    out->buf[p] = reference(plane, frame.storage);
    if (!out->buf[p]) throw runtime_failure("", "out of memory for a frame");
  }
  out->extended_data = out->data;
  return out;
}

}  // namespace rinkaku::ffmpeg
