#include "tests/support/fake_camera/fake_camera.h"

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/timerfd.h>
#include <time.h>
#include <unistd.h>

namespace {

std::string setting(const char* name, const char* preset = "") {
  const char* value = std::getenv(name);
  return value ? value : preset;
}
long number(const char* name, long preset = 0) { return std::stol(setting(name, std::to_string(preset).c_str())); }

std::int64_t now_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec;
}

struct Size {
  __u32 width, height;
};

struct State {
  int descriptor = -1, memory = -1, output = -1;
  std::uint8_t* base = nullptr;
  std::size_t slot_bytes = 0;
  __u32 slots = 0;
  v4l2_pix_format format{};
  std::deque<__u32> queued;
  bool on = false, broken = false;
  std::int64_t start_ns = 0, beats = 0, back_at_ns = 0;
  long since_start = 0;  // pictures
  int brightness = 100, automatic = 1, exposure = 50;
  std::vector<std::uint8_t> pictures;
} camera;

std::vector<__u32> formats() {
  std::vector<__u32> all;
  std::string names = setting("FAKE_CAMERA_FORMATS", "YUYV") + ",";
  for (std::size_t at = 0; at + 4 < names.size() + 1 && names.size() >= at + 5; at += 5) {
    all.push_back(v4l2_fourcc(names[at], names[at + 1], names[at + 2], names[at + 3]));
  }
  return all;
}

std::vector<Size> sizes() {
  std::vector<Size> all;
  Size own{};
  if (std::sscanf(setting("FAKE_CAMERA_SIZE").c_str(), "%ux%u", &own.width, &own.height) == 2) all.push_back(own);
  all.push_back({640, 480});
  all.push_back({320, 240});
  return all;
}

void set_format(__u32 code, __u32 width, __u32 height) {
  v4l2_pix_format& f = camera.format;
  f = {};
  f.pixelformat = code;
  f.width = width;
  f.height = height;
  f.field = V4L2_FIELD_NONE;
  f.colorspace = V4L2_COLORSPACE_SRGB;
  const bool packed = code == V4L2_PIX_FMT_YUYV || code == V4L2_PIX_FMT_UYVY;
  const bool half = code == V4L2_PIX_FMT_NV12 || code == V4L2_PIX_FMT_YUV420;
  f.bytesperline = code == V4L2_PIX_FMT_MJPEG ? 0 : packed ? width * 2 : width;
  f.sizeimage = packed ? width * 2 * height : half ? width * height * 3 / 2 : width * height;
}

int fail(int code) {
  errno = code;
  return -1;
}

void beat(bool on) {
  const long period_ns = 1'000'000'000 / number("FAKE_CAMERA_FPS", 30);
  itimerspec timer{};
  if (on) timer.it_value.tv_nsec = timer.it_interval.tv_nsec = period_ns;
  timerfd_settime(camera.descriptor, 0, &timer, nullptr);
  camera.start_ns = now_ns();
  camera.beats = 0;
  camera.since_start = 0;
  camera.on = on;
  camera.broken = false;
}

std::size_t fill(std::uint8_t* to, std::uint32_t sequence) {
  const std::size_t bytes = camera.format.sizeimage;
  if (camera.format.pixelformat == V4L2_PIX_FMT_MJPEG && !camera.pictures.empty()) {
    std::memcpy(to, camera.pictures.data(), std::min(bytes, camera.pictures.size()));
    return std::min(bytes, camera.pictures.size());
  }
  if (const std::size_t count = camera.pictures.size() / bytes) {
    std::memcpy(to, camera.pictures.data() + sequence % count * bytes, bytes);
  } else {
    for (std::size_t i = 0; i < bytes; ++i) to[i] = rinkaku::test::fake_sample(sequence, i);
  }
  return bytes;
}

bool every(const char* name, long count) {
  const long n = number(name);
  return n > 0 && count > 0 && count % n == 0;
}

int dequeue(v4l2_buffer& buffer) {
  if (camera.back_at_ns > 0) return fail(ENODEV);
  if (camera.broken) return fail(EIO);
  std::uint64_t passed = 0;
  if (!camera.on || camera.queued.empty() || read(camera.descriptor, &passed, 8) != 8) return fail(EAGAIN);
  camera.beats += static_cast<std::int64_t>(passed);
  if (number("FAKE_CAMERA_SILENT_AFTER") > 0 && camera.since_start >= number("FAKE_CAMERA_SILENT_AFTER")) {
    return fail(EAGAIN);
  }
  ++camera.since_start;
  if (every("FAKE_CAMERA_UNPLUG_EVERY", camera.since_start)) {
    camera.back_at_ns = now_ns() + number("FAKE_CAMERA_AWAY_MS", 200) * 1'000'000;
    return fail(ENODEV);
  }
  if (every("FAKE_CAMERA_BREAK_EVERY", camera.since_start)) {
    camera.broken = true;
    return fail(EIO);
  }
  if (every("FAKE_CAMERA_LOSE_EVERY", camera.beats)) return fail(EAGAIN);
  const __u32 slot = camera.queued.front();
  camera.queued.pop_front();
  const auto sequence = static_cast<__u32>(camera.beats - 1);
  const std::size_t used = fill(camera.base + slot * camera.slot_bytes, sequence);
  const std::int64_t stamp = camera.start_ns + camera.beats * (1'000'000'000 / number("FAKE_CAMERA_FPS", 30));
  buffer.index = slot;
  buffer.bytesused = static_cast<__u32>(used);
  buffer.sequence = sequence;
  buffer.flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
  if (every("FAKE_CAMERA_DAMAGE_EVERY", camera.beats)) buffer.flags |= V4L2_BUF_FLAG_ERROR;
  buffer.timestamp.tv_sec = stamp / 1'000'000'000;
  buffer.timestamp.tv_usec = stamp % 1'000'000'000 / 1000;
  return 0;
}

int query_control(v4l2_queryctrl& q) {
  const bool next = q.id & V4L2_CTRL_FLAG_NEXT_CTRL;
  const __u32 id = q.id & ~static_cast<__u32>(V4L2_CTRL_FLAG_NEXT_CTRL);
  const v4l2_queryctrl all[] = {{V4L2_CID_BRIGHTNESS, V4L2_CTRL_TYPE_INTEGER, "Brightness", 0, 255, 1, 100, 0, {}},
                                {V4L2_CID_EXPOSURE_AUTO, V4L2_CTRL_TYPE_MENU, "Auto Exposure", 0, 1, 1, 1, 0, {}},
                                {V4L2_CID_EXPOSURE_ABSOLUTE,
                                 V4L2_CTRL_TYPE_INTEGER,
                                 "Exposure Time, Absolute",
                                 1,
                                 500,
                                 1,
                                 50,
                                 camera.automatic ? __u32{V4L2_CTRL_FLAG_INACTIVE} : 0,
                                 {}}};
  for (const v4l2_queryctrl& each : all) {
    if (next ? each.id > id : each.id == id) {
      q = each;
      return 0;
    }
  }
  return fail(EINVAL);
}

int* control_value(__u32 id) {
  return id == V4L2_CID_BRIGHTNESS          ? &camera.brightness
         : id == V4L2_CID_EXPOSURE_AUTO     ? &camera.automatic
         : id == V4L2_CID_EXPOSURE_ABSOLUTE ? &camera.exposure
                                            : nullptr;
}

int answer(unsigned long code, void* argument) {
  switch (static_cast<__u32>(code)) {
    case static_cast<__u32>(VIDIOC_QUERYCAP): {
      auto& told = *static_cast<v4l2_capability*>(argument);
      told = {};
      std::strcpy(reinterpret_cast<char*>(told.driver), "fake");
      std::strcpy(reinterpret_cast<char*>(told.card), "Fake Camera");
      std::strcpy(reinterpret_cast<char*>(told.bus_info), "usb-fake-1");
      told.device_caps = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
      told.capabilities = told.device_caps | V4L2_CAP_DEVICE_CAPS;
      return 0;
    }
    case static_cast<__u32>(VIDIOC_ENUM_FMT): {
      auto& f = *static_cast<v4l2_fmtdesc*>(argument);
      if (f.index >= formats().size()) return fail(EINVAL);
      f.pixelformat = formats()[f.index];
      return 0;
    }
    case static_cast<__u32>(VIDIOC_ENUM_FRAMESIZES): {
      auto& f = *static_cast<v4l2_frmsizeenum*>(argument);
      if (f.index >= sizes().size()) return fail(EINVAL);
      f.type = V4L2_FRMSIZE_TYPE_DISCRETE;
      f.discrete = {sizes()[f.index].width, sizes()[f.index].height};
      return 0;
    }
    case static_cast<__u32>(VIDIOC_ENUM_FRAMEINTERVALS): {
      auto& f = *static_cast<v4l2_frmivalenum*>(argument);
      if (f.index > 0) return fail(EINVAL);
      f.type = V4L2_FRMIVAL_TYPE_DISCRETE;
      f.discrete = {1, static_cast<__u32>(number("FAKE_CAMERA_FPS", 30))};
      return 0;
    }
    case static_cast<__u32>(VIDIOC_S_FMT): {
      auto& f = *static_cast<v4l2_format*>(argument);
      set_format(f.fmt.pix.pixelformat, f.fmt.pix.width, f.fmt.pix.height);
      f.fmt.pix = camera.format;
      return 0;
    }
    case static_cast<__u32>(VIDIOC_S_PARM):
    case static_cast<__u32>(VIDIOC_G_PARM):
      static_cast<v4l2_streamparm*>(argument)->parm.capture.timeperframe = {
          1, static_cast<__u32>(number("FAKE_CAMERA_FPS", 30))};
      return 0;
    case static_cast<__u32>(VIDIOC_REQBUFS): {
      auto& wanted = *static_cast<v4l2_requestbuffers*>(argument);
      if (camera.base) munmap(camera.base, camera.slot_bytes * camera.slots);
      if (camera.memory >= 0) syscall(SYS_close, camera.memory);
      camera.base = nullptr;
      camera.memory = -1;
      camera.queued.clear();
      camera.slots = wanted.count;
      if (wanted.count == 0) return 0;
      camera.slot_bytes = (camera.format.sizeimage + 4095u) & ~std::size_t{4095};
      camera.memory = memfd_create("fake_camera", MFD_CLOEXEC);
      const auto bytes = static_cast<off_t>(camera.slot_bytes * wanted.count);
      if (camera.memory < 0 || ftruncate(camera.memory, bytes) != 0) return fail(ENOMEM);
      camera.base = reinterpret_cast<std::uint8_t*>(syscall(SYS_mmap, nullptr, static_cast<std::size_t>(bytes),
                                                            PROT_READ | PROT_WRITE, MAP_SHARED, camera.memory, 0));
      return 0;
    }
    case static_cast<__u32>(VIDIOC_QUERYBUF): {
      auto& buffer = *static_cast<v4l2_buffer*>(argument);
      buffer.length = camera.format.sizeimage;
      buffer.m.offset = static_cast<__u32>(buffer.index * camera.slot_bytes);
      return 0;
    }
    case static_cast<__u32>(VIDIOC_QBUF):
      camera.queued.push_back(static_cast<v4l2_buffer*>(argument)->index);
      return 0;
    case static_cast<__u32>(VIDIOC_DQBUF):
      return dequeue(*static_cast<v4l2_buffer*>(argument));
    case static_cast<__u32>(VIDIOC_STREAMON):
      beat(true);
      return 0;
    case static_cast<__u32>(VIDIOC_STREAMOFF):
      beat(false);
      return 0;
    case static_cast<__u32>(VIDIOC_QUERYCTRL):
      return query_control(*static_cast<v4l2_queryctrl*>(argument));
    case static_cast<__u32>(VIDIOC_QUERYMENU): {
      auto& entry = *static_cast<v4l2_querymenu*>(argument);
      std::strcpy(reinterpret_cast<char*>(entry.name), entry.index == 0 ? "Manual Mode" : "Auto Mode");
      return 0;
    }
    case static_cast<__u32>(VIDIOC_G_CTRL): {
      auto& c = *static_cast<v4l2_control*>(argument);
      c.value = control_value(c.id) ? *control_value(c.id) : 0;
      return 0;
    }
    case static_cast<__u32>(VIDIOC_S_CTRL): {
      const auto& c = *static_cast<v4l2_control*>(argument);
      if (!control_value(c.id)) return fail(EINVAL);
      *control_value(c.id) = c.value;
      return 0;
    }
    default:
      return fail(ENOTTY);
  }
}

int open_it() {
  if (number("FAKE_CAMERA_UNPLUG_EVERY") > 0 && camera.back_at_ns > now_ns()) return fail(ENOENT);
  camera.back_at_ns = 0;
  camera.descriptor = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
  if (camera.pictures.empty() && !setting("FAKE_CAMERA_FRAMES").empty()) {
    std::ifstream file(setting("FAKE_CAMERA_FRAMES"), std::ios::binary);
    camera.pictures.assign(std::istreambuf_iterator<char>(file), {});
  }
  return camera.descriptor;
}

int answer_as_output(unsigned long code, void* argument) {
  if (static_cast<__u32>(code) == static_cast<__u32>(VIDIOC_QUERYCAP)) {
    auto& told = *static_cast<v4l2_capability*>(argument);
    told = {};
    told.device_caps = V4L2_CAP_VIDEO_OUTPUT | V4L2_CAP_READWRITE;
    told.capabilities = told.device_caps | V4L2_CAP_DEVICE_CAPS;
    return 0;
  }
  return static_cast<__u32>(code) == static_cast<__u32>(VIDIOC_S_FMT) ? 0 : fail(ENOTTY);
}

int open_other(const char* path, int flags, mode_t mode) {
  const int opened = static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
  if (path && !setting("FAKE_OUTPUT").empty() && setting("FAKE_OUTPUT") == path) camera.output = opened;
  return opened;
}

bool is_it(const char* path) { return path && !setting("FAKE_CAMERA").empty() && setting("FAKE_CAMERA") == path; }

void* map(void* address, std::size_t length, int protection, int flags, int descriptor, off_t offset) {
  if (descriptor >= 0 && descriptor == camera.descriptor) descriptor = camera.memory;
  return reinterpret_cast<void*>(syscall(SYS_mmap, address, length, protection, flags, descriptor, offset));
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list list;
  va_start(list, flags);
  const mode_t mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(list, mode_t) : 0;
  va_end(list);
  return is_it(path) ? open_it() : open_other(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list list;
  va_start(list, flags);
  const mode_t mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(list, mode_t) : 0;
  va_end(list);
  return is_it(path) ? open_it() : open_other(path, flags, mode);
}

int close(int descriptor) {
  if (descriptor >= 0 && descriptor == camera.descriptor) {
    camera.descriptor = -1;
    camera.on = false;
  }
  return static_cast<int>(syscall(SYS_close, descriptor));
}

int ioctl(int descriptor, unsigned long code, ...) {
  va_list list;
  va_start(list, code);
  void* argument = va_arg(list, void*);
  va_end(list);
  if (descriptor >= 0 && descriptor == camera.descriptor) return answer(code, argument);
  if (descriptor >= 0 && descriptor == camera.output) return answer_as_output(code, argument);
  return static_cast<int>(syscall(SYS_ioctl, descriptor, code, argument));
}

void* mmap(void* address, std::size_t length, int protection, int flags, int descriptor, off_t offset) {
  return map(address, length, protection, flags, descriptor, offset);
}
void* mmap64(void* address, std::size_t length, int protection, int flags, int descriptor, off_t offset) {
  return map(address, length, protection, flags, descriptor, offset);
}
}
