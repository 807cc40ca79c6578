#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rinkaku::source::v4l2 {

/// An open file descriptor, closed when it goes. Move-only.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;
  ~Descriptor();
  int number() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }

 private:
  int number_ = -1;
};

/// ioctl() that goes on after signals: 0, or the errno it failed with.
int request(const Descriptor& device, unsigned long code, void* argument);

/// What a camera is known by when it comes back under another number.
struct Identity {
  std::string card;    ///< the model, as the driver names it
  std::string bus;     ///< where it is plugged in, e.g. "usb-0000:00:14.0-1"
  std::string serial;  ///< of a USB device; empty if it tells none
  bool operator==(const Identity&) const = default;
};

/// An opened camera that streams by memory mapping.
struct Device {
  std::string path;
  Descriptor descriptor;
  std::string driver;
  Identity identity;
};

/// Opens a camera without waiting, even if another program streams from it.
/// Throws Error (Input) if there is none of that name, it may not be opened, or it is no camera that streams.
Device open_device(const std::string& path);

/// The paths of everything that might be a camera, /dev/video0 first.
std::vector<std::string> device_paths();

/// How surely `found` is the camera `wanted`: 0 if it isn't, and the larger the surer. The same model elsewhere counts
/// only if nothing better is there.
int likeness(const Identity& wanted, const Identity& found);

}  // namespace rinkaku::source::v4l2
