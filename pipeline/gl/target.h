#pragma once

#include <cstdint>

#include "pipeline/gl/handle.h"

namespace rinkaku::gl {

/// What is drawn into: RGBA8 colour (premultiplied) and 32-bit float depth. Grows to the largest size asked for.
class Target {
 public:
  Target();

  /// Binds the target with a viewport of width x height at its origin, cleared to nothing: colour 0, depth 0 (depth is
  /// reversed: 1 at the near plane, 0 infinitely far), or `depth`.
  void begin(int width_px, int height_px, double depth = 0);

  /// Copies the viewport's pixels to `rgba`: width * height * 4 bytes, the row of window y = 0 first. Waits for drawing
  /// to end.
  void read(int width_px, int height_px, std::uint8_t* rgba) const;

 private:
  FramebufferHandle framebuffer_;
  RenderbufferHandle colour_;
  RenderbufferHandle depth_;
  int width_px_ = 0;
  int height_px_ = 0;
};

}  // namespace rinkaku::gl
