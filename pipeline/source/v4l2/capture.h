#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/frame/picture_format.h"
#include "pipeline/source/v4l2/device.h"
#include "pipeline/source/v4l2/modes.h"

namespace rinkaku::source::v4l2 {

/// What a camera said it will send, after it was asked.
struct Agreed {
  FourCc format = 0;
  int width_px = 0;
  int height_px = 0;
  int stride_bytes = 0;
  Rational rate{0, 1};  ///< 0/1 if it doesn't tell
  ColourTags colour;
  bool interlaced = false;
  bool top_field_first = false;
};

/// A picture in the driver's memory, until it is given back.
struct Taken {
  std::span<const std::uint8_t> bytes;
  std::int64_t captured_ns = 0;  ///< monotonic clock; the driver's stamp if it uses that clock, else when it was taken
  std::uint32_t sequence = 0;    ///< the driver's count; gaps are pictures that were lost before they came here
  bool damaged = false;          ///< the driver says so
  std::uint32_t index = 0;
};

/// A running stream of memory-mapped buffers. Stopped, unmapped and closed when it goes. One thread.
class Capture {
 public:
  /// Negotiates and starts. Throws Error: Input if the camera takes nothing of the kind, Runtime if it fails or another
  /// program uses it.
  Capture(Device device, const Choice& choice);
  ~Capture();
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  const Device& device() const { return device_; }
  const Agreed& agreed() const { return agreed_; }
  int poll_descriptor() const { return device_.descriptor.number(); }

  enum class Failure { None, NothingYet, Gone, Broken };
  /// The next picture if one is there. Gone: the device was unplugged. Broken: the stream must be started anew.
  Failure take(Taken& taken);
  /// Lets the driver fill the buffer again. False if the device is gone.
  bool give_back(const Taken& taken);

 private:
  struct Mapping {
    void* start = nullptr;
    std::size_t length = 0;
  };
  void negotiate(const Choice& choice);
  void map_buffers();
  void unmap();

  Device device_;
  Agreed agreed_;
  std::vector<Mapping> mappings_;
  bool streaming_ = false;
};

/// Nanoseconds of the monotonic clock.
std::int64_t monotonic_ns();

}  // namespace rinkaku::source::v4l2
