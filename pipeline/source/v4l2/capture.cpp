#include "pipeline/source/v4l2/capture.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>

#include <linux/videodev2.h>
#include <sys/mman.h>

#include "pipeline/frame/error.h"

namespace rinkaku::source::v4l2 {
namespace {

// Pictures are copied out at once, so few are needed; some more bridge a moment in which nobody looks.
constexpr __u32 buffer_count = 6;
// A stamp farther from now than this is no stamp of this picture.
constexpr std::int64_t believable_age_ns = 2'000'000'000;

Error failed(const Device& device, const char* what, int code) {
  if (code == EBUSY) {
    return runtime_failure(device.path, "another program uses the camera", "end that program, or take another camera");
  }
  return runtime_failure(device.path, std::string(what) + ": " + std::strerror(code),
                         "unplug the camera and plug it in again");
}

bool is_interlaced(__u32 field) {
  return field == V4L2_FIELD_INTERLACED || field == V4L2_FIELD_INTERLACED_TB || field == V4L2_FIELD_INTERLACED_BT;
}

std::int64_t stamp_ns(const v4l2_buffer& buffer) {
  const std::int64_t now = monotonic_ns();
  if ((buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) != V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC) return now;
  const std::int64_t stamp = buffer.timestamp.tv_sec * std::int64_t{1'000'000'000} + buffer.timestamp.tv_usec * 1000LL;
  return stamp > now || stamp < now - believable_age_ns ? now : stamp;
}

}  // namespace

std::int64_t monotonic_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

Capture::Capture(Device device, const Choice& choice) : device_(std::move(device)) {
  negotiate(choice);
  try {
    map_buffers();
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (const int code = request(device_.descriptor, VIDIOC_STREAMON, &type)) {
      throw failed(device_, "the camera doesn't start", code);
    }
    streaming_ = true;
  } catch (...) {
    unmap();
    throw;
  }
}

Capture::~Capture() {
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (streaming_) request(device_.descriptor, VIDIOC_STREAMOFF, &type);
  unmap();
}

void Capture::negotiate(const Choice& choice) {
  v4l2_format format{};
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  format.fmt.pix.width = static_cast<__u32>(choice.width_px);
  format.fmt.pix.height = static_cast<__u32>(choice.height_px);
  format.fmt.pix.pixelformat = choice.format;
  format.fmt.pix.field = V4L2_FIELD_ANY;
  if (const int code = request(device_.descriptor, VIDIOC_S_FMT, &format)) {
    throw failed(device_, "the camera doesn't take a picture format", code);
  }
  const v4l2_pix_format& got = format.fmt.pix;
  if (!readable(got.pixelformat)) {
    throw input_error(device_.path, "the camera sends " + name_of(got.pixelformat) + ", which isn't read",
                      "choose another format; 'rinkaku devices' lists them");
  }
  agreed_.format = got.pixelformat;
  agreed_.width_px = static_cast<int>(got.width);
  agreed_.height_px = static_cast<int>(got.height);
  agreed_.stride_bytes = static_cast<int>(got.bytesperline);
  agreed_.colour = colour_of(got);
  agreed_.interlaced = is_interlaced(got.field);
  agreed_.top_field_first = got.field != V4L2_FIELD_INTERLACED_BT;
  v4l2_streamparm rate{};
  rate.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (choice.rate.num > 0) {
    rate.parm.capture.timeperframe = {static_cast<__u32>(choice.rate.den), static_cast<__u32>(choice.rate.num)};
    request(device_.descriptor, VIDIOC_S_PARM, &rate);
  }
  if (request(device_.descriptor, VIDIOC_G_PARM, &rate) == 0 && rate.parm.capture.timeperframe.numerator > 0) {
    agreed_.rate = {rate.parm.capture.timeperframe.denominator, rate.parm.capture.timeperframe.numerator};
  }
}

void Capture::map_buffers() {
  v4l2_requestbuffers wanted{};
  wanted.count = buffer_count;
  wanted.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  wanted.memory = V4L2_MEMORY_MMAP;
  if (const int code = request(device_.descriptor, VIDIOC_REQBUFS, &wanted)) {
    throw failed(device_, "the camera gives no memory", code);
  }
  if (wanted.count < 2) throw failed(device_, "the camera gives too little memory", ENOMEM);
  for (__u32 i = 0; i < wanted.count; ++i) {
    v4l2_buffer buffer{};
    buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    buffer.memory = V4L2_MEMORY_MMAP;
    buffer.index = i;
    if (const int code = request(device_.descriptor, VIDIOC_QUERYBUF, &buffer)) {
      throw failed(device_, "the camera's memory can't be found", code);
    }
    void* start = ::mmap(nullptr, buffer.length, PROT_READ | PROT_WRITE, MAP_SHARED, device_.descriptor.number(),
                         static_cast<off_t>(buffer.m.offset));
    if (start == MAP_FAILED) throw failed(device_, "the camera's memory can't be mapped", errno);
    mappings_.push_back({start, buffer.length});
    if (const int code = request(device_.descriptor, VIDIOC_QBUF, &buffer)) {
      throw failed(device_, "the camera doesn't take its memory", code);
    }
  }
}

void Capture::unmap() {
  for (const Mapping& mapping : mappings_) ::munmap(mapping.start, mapping.length);
  mappings_.clear();
  v4l2_requestbuffers none{};
  none.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  none.memory = V4L2_MEMORY_MMAP;
  request(device_.descriptor, VIDIOC_REQBUFS, &none);
}

Capture::Failure Capture::take(Taken& taken) {
  v4l2_buffer buffer{};
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  switch (request(device_.descriptor, VIDIOC_DQBUF, &buffer)) {
    case 0:
      break;
    case EAGAIN:
      return Failure::NothingYet;
    case ENODEV:
    case ENXIO:
    case EBADF:
      return Failure::Gone;
    default:
      return Failure::Broken;
  }
  if (buffer.index >= mappings_.size()) return Failure::Broken;
  const Mapping& mapping = mappings_[buffer.index];
  const std::size_t used = std::min<std::size_t>(buffer.bytesused, mapping.length);
  taken.bytes = {static_cast<const std::uint8_t*>(mapping.start), used};
  taken.captured_ns = stamp_ns(buffer);
  taken.sequence = buffer.sequence;
  taken.damaged = (buffer.flags & V4L2_BUF_FLAG_ERROR) != 0 || used == 0;
  taken.index = buffer.index;
  return Failure::None;
}

bool Capture::give_back(const Taken& taken) {
  v4l2_buffer buffer{};
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  buffer.index = taken.index;
  return request(device_.descriptor, VIDIOC_QBUF, &buffer) == 0;
}

}  // namespace rinkaku::source::v4l2
