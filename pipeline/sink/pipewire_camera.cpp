#include "pipeline/sink/pipewire_camera.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

#include <pipewire/pipewire.h>
#include <spa/param/video/format-utils.h>

#include "pipeline/frame/error.h"
#include "pipeline/sink/yuyv_packer.h"

namespace rinkaku::sink {
namespace {

constexpr int connect_s = 3;
constexpr int buffers = 4, fewest_buffers = 2, most_buffers = 8;

spa_fraction rate_of(const Incoming& incoming) {
  if (incoming.frame_rate.num <= 0) return {30, 1};
  return {static_cast<std::uint32_t>(incoming.frame_rate.num), static_cast<std::uint32_t>(incoming.frame_rate.den)};
}

// Holds PipeWire's loop while it is looked at from another thread.
class Held {
 public:
  explicit Held(pw_thread_loop* loop) : loop_(loop) { pw_thread_loop_lock(loop_); }
  ~Held() { pw_thread_loop_unlock(loop_); }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;

 private:
  pw_thread_loop* loop_;
};

class PipewireCamera final : public Sink {
 public:
  explicit PipewireCamera(const Incoming& incoming);
  ~PipewireCamera() override;
  PipewireCamera(const PipewireCamera&) = delete;
  PipewireCamera& operator=(const PipewireCamera&) = delete;

  void write(const Frame& frame) override;
  void finish() override {}
  std::string notice() const override;

 private:
  void connect(const Incoming& incoming);
  void close();
  static void on_state(void* self, pw_stream_state old, pw_stream_state now, const char* error);
  static void on_format(void* self, std::uint32_t id, const spa_pod* format);
  static void on_process(void* self);

  YuyvPacker packer_;
  pw_thread_loop* loop_ = nullptr;
  pw_stream* stream_ = nullptr;
  pw_stream_events events_{};
  // With the loop held only:
  std::vector<std::uint8_t> newest_;
  pw_stream_state state_ = PW_STREAM_STATE_UNCONNECTED;
  std::string trouble_;
};

PipewireCamera::PipewireCamera(const Incoming& incoming) : packer_(incoming.format) {
  pw_init(nullptr, nullptr);
  try {
    connect(incoming);
  } catch (...) {
    close();
    throw;
  }
}

void PipewireCamera::connect(const Incoming& incoming) {
  const auto failed = [](const std::string& why) {
    return runtime_failure("PipeWire", "no camera can be made: " + why,
                           "start PipeWire, or give a video output device such as v4l2loopback makes");
  };
  loop_ = pw_thread_loop_new("rinkaku-camera", nullptr);
  if (!loop_ || pw_thread_loop_start(loop_) != 0) throw failed("its thread doesn't start");
  const Held held(loop_);
  events_.version = PW_VERSION_STREAM_EVENTS;
  events_.state_changed = on_state;
  events_.param_changed = on_format;
  events_.process = on_process;
  pw_properties* properties =
      pw_properties_new(PW_KEY_MEDIA_CLASS, "Video/Source", PW_KEY_MEDIA_ROLE, "Camera", PW_KEY_NODE_NAME, "rinkaku",
                        PW_KEY_NODE_DESCRIPTION, "rinkaku", nullptr);
  stream_ = pw_stream_new_simple(pw_thread_loop_get_loop(loop_), "rinkaku", properties, &events_, this);
  if (!stream_) throw failed(std::strerror(errno));
  std::array<std::uint8_t, 1024> memory{};
  spa_pod_builder builder{};
  spa_pod_builder_init(&builder, memory.data(), memory.size());
  const PictureFormat& format = packer_.format();
  spa_video_info_raw info{};
  info.format = SPA_VIDEO_FORMAT_YUY2;
  info.size = {static_cast<std::uint32_t>(format.width_px), static_cast<std::uint32_t>(format.height_px)};
  info.framerate = rate_of(incoming);
  const spa_pod* offered[] = {spa_format_video_raw_build(&builder, SPA_PARAM_EnumFormat, &info)};
  const auto flags = static_cast<pw_stream_flags>(PW_STREAM_FLAG_DRIVER | PW_STREAM_FLAG_MAP_BUFFERS);
  if (const int code = pw_stream_connect(stream_, PW_DIRECTION_OUTPUT, PW_ID_ANY, flags, offered, 1); code < 0) {
    throw failed(std::strerror(-code));
  }
  while (state_ == PW_STREAM_STATE_UNCONNECTED || state_ == PW_STREAM_STATE_CONNECTING) {
    if (pw_thread_loop_timed_wait(loop_, connect_s) != 0) throw failed("it doesn't answer");
  }
  if (state_ == PW_STREAM_STATE_ERROR) throw failed(trouble_);
}

void PipewireCamera::close() {
  if (stream_) {
    const Held held(loop_);
    pw_stream_destroy(stream_);
  }
  if (loop_) {
    pw_thread_loop_stop(loop_);
    pw_thread_loop_destroy(loop_);
  }
  pw_deinit();
}

PipewireCamera::~PipewireCamera() { close(); }

void PipewireCamera::on_state(void* self, pw_stream_state /*old*/, pw_stream_state now, const char* error) {
  auto& camera = *static_cast<PipewireCamera*>(self);
  camera.state_ = now;
  if (now == PW_STREAM_STATE_ERROR) camera.trouble_ = error ? error : "it ended";
  pw_thread_loop_signal(camera.loop_, false);
}

void PipewireCamera::on_format(void* self, std::uint32_t id, const spa_pod* format) {
  if (id != SPA_PARAM_Format || !format) return;
  auto& camera = *static_cast<PipewireCamera*>(self);
  const int stride = camera.packer_.stride_bytes(), size = stride * camera.packer_.format().height_px;
  std::array<std::uint8_t, 512> memory{};
  spa_pod_builder builder{};
  spa_pod_builder_init(&builder, memory.data(), memory.size());
  const spa_pod* wanted[] = {static_cast<const spa_pod*>(spa_pod_builder_add_object(
      &builder, SPA_TYPE_OBJECT_ParamBuffers, SPA_PARAM_Buffers, SPA_PARAM_BUFFERS_buffers,
      SPA_POD_CHOICE_RANGE_Int(buffers, fewest_buffers, most_buffers), SPA_PARAM_BUFFERS_blocks, SPA_POD_Int(1),
      SPA_PARAM_BUFFERS_size, SPA_POD_Int(size), SPA_PARAM_BUFFERS_stride, SPA_POD_Int(stride)))};
  pw_stream_update_params(camera.stream_, wanted, 1);
}

// On PipeWire's thread, with the loop held: a reader wants the newest frame.
void PipewireCamera::on_process(void* self) {
  auto& camera = *static_cast<PipewireCamera*>(self);
  pw_buffer* taken = pw_stream_dequeue_buffer(camera.stream_);
  if (!taken) return;
  spa_data& data = taken->buffer->datas[0];
  const std::size_t bytes = std::min<std::size_t>(data.maxsize, camera.newest_.size());
  if (data.data) std::memcpy(data.data, camera.newest_.data(), bytes);
  data.chunk->offset = 0;
  data.chunk->stride = camera.packer_.stride_bytes();
  data.chunk->size = data.data ? static_cast<std::uint32_t>(bytes) : 0;
  pw_stream_queue_buffer(camera.stream_, taken);
}

void PipewireCamera::write(const Frame& frame) {
  const std::span<const std::uint8_t> packed = packer_.pack(frame);
  const Held held(loop_);
  newest_.assign(packed.begin(), packed.end());
  if (state_ == PW_STREAM_STATE_STREAMING) pw_stream_trigger_process(stream_);
}

std::string PipewireCamera::notice() const {
  const Held held(loop_);
  return trouble_.empty() ? trouble_ : "PipeWire: the camera ended early: " + trouble_;
}

}  // namespace

std::unique_ptr<Sink> open_pipewire_camera(const Incoming& incoming) {
  return std::make_unique<PipewireCamera>(incoming);
}

}  // namespace rinkaku::sink
