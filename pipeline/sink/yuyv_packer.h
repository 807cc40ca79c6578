#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/ffmpeg/converter.h"
#include "pipeline/frame/frame.h"

namespace rinkaku::sink {

/// Frames as programs take them from a camera: YUYV, limited range. Planar 8-bit 4:2:2 is packed as it is, 4:2:0 with
/// its chroma rows doubled, all else is converted first. One thread; about 0.3 ms at 1280x720 for what is planar.
class YuyvPacker {
 public:
  explicit YuyvPacker(const PictureFormat& coming);

  /// What the packed pictures are: the size, and colour tags in limited range.
  const PictureFormat& format() const { return planar_; }
  int stride_bytes() const { return stride_bytes_; }

  /// Rows of stride_bytes(), from the top; valid until the next call.
  std::span<const std::uint8_t> pack(const Frame& frame);

 private:
  PictureFormat planar_;
  int stride_bytes_ = 0;
  std::vector<std::uint8_t> packed_;
  std::optional<ffmpeg::Converter> converter_;
};

}  // namespace rinkaku::sink
