#include "pipeline/source/v4l2/device.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "pipeline/frame/error.h"

namespace rinkaku::source::v4l2 {
namespace {

namespace fs = std::filesystem;

constexpr const char* see_devices = "'rinkaku devices' lists the cameras there are";

template <std::size_t N>
std::string text_of(const __u8 (&field)[N]) {
  const char* text = reinterpret_cast<const char*>(field);
  return {text, ::strnlen(text, N)};
}

// Where sysfs keeps the USB device's serial number; empty for all else.
std::string serial_of(const std::string& path) {
  const fs::path device = fs::path("/sys/class/video4linux") / fs::path(path).filename() / "device";
  std::string serial;
  std::ifstream(device / ".." / "serial") >> serial;
  return serial;
}

int number_in(const std::string& path) {
  const std::size_t digits = path.find_last_not_of("0123456789") + 1;
  return digits < path.size() && path.size() - digits < 9 ? std::stoi(path.substr(digits)) : -1;
}

}  // namespace

Descriptor::Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(number_, other.number_);
  return *this;
}

Descriptor::~Descriptor() {
  if (number_ >= 0) ::close(number_);
}

int request(const Descriptor& device, unsigned long code, void* argument) {
  while (::ioctl(device.number(), code, argument) != 0) {
    if (errno != EINTR) return errno;
  }
  return 0;
}

Device open_device(const std::string& path) {
  Device device;
  device.path = path;
  device.descriptor = Descriptor(::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC));
  if (!device.descriptor) {
    const int code = errno;
    if (code == ENOENT || code == ENODEV || code == ENXIO) {
      throw input_error(path, "there is no such camera", see_devices);
    }
    const bool forbidden = code == EACCES || code == EPERM;
    throw input_error(path, std::string("can't be opened: ") + std::strerror(code),
                      forbidden ? "join the group 'video', or run as a user who may" : see_devices);
  }
  v4l2_capability told{};
  if (request(device.descriptor, VIDIOC_QUERYCAP, &told) != 0) {
    throw input_error(path, "is no video device", see_devices);
  }
  const __u32 can = told.capabilities & V4L2_CAP_DEVICE_CAPS ? told.device_caps : told.capabilities;
  if (!(can & V4L2_CAP_VIDEO_CAPTURE)) throw input_error(path, "is a video device, but no camera", see_devices);
  if (!(can & V4L2_CAP_STREAMING)) throw input_error(path, "the camera can't stream", see_devices);
  device.driver = text_of(told.driver);
  device.identity = {text_of(told.card), text_of(told.bus_info), serial_of(path)};
  return device;
}

std::vector<std::string> device_paths() {
  std::vector<std::string> paths;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator("/dev", error)) {
    if (entry.path().filename().string().starts_with("video") && entry.is_character_file(error)) {
      paths.push_back(entry.path().string());
    }
  }
  std::sort(paths.begin(), paths.end(),
            [](const std::string& a, const std::string& b) { return number_in(a) < number_in(b); });
  return paths;
}

int likeness(const Identity& wanted, const Identity& found) {
  if (wanted.card != found.card) return 0;
  const bool same_place = wanted.bus == found.bus;
  if (!wanted.serial.empty() && !found.serial.empty()) {
    return wanted.serial != found.serial ? 0 : same_place ? 4 : 3;
  }
  return same_place ? 2 : 1;
}

}  // namespace rinkaku::source::v4l2
