#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "pipeline/frame/frame.h"

namespace rinkaku::window {

/// Frames as 8-bit RGB for the screen, on the CPU. One thread; keeps its memory between frames.
/// Planar 8-bit Y'CbCr and grey take about 1 ms at 1280x720, all else 5 to 15.
class RgbaConverter {
 public:
  RgbaConverter();
  ~RgbaConverter();

  /// width * height * 4 bytes, R G B A, rows from the top, sRGB-encoded as the frame is; valid until the next call.
  /// Throws Error (Input) for a format that can't be converted.
  const std::uint8_t* convert(const Frame& frame);

 private:
  struct Scaler;
  std::vector<std::uint8_t> rgba_;
  std::unique_ptr<Scaler> scaler_;
};

}  // namespace rinkaku::window
