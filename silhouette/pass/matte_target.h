#pragma once

#include <cstdint>

#include "pipeline/gl/handle.h"

namespace rinkaku::silhouette {

/// What mattes are drawn into: one 8-bit channel, no depth, one sample a pixel. Grows to the largest size asked for.
/// Needs a current GL context.
class MatteTarget {
 public:
  MatteTarget();

  /// Binds the target with a viewport of width x height at its origin, cleared to 0. Throws Error (Runtime) if the
  /// driver does not draw pictures of this size.
  void begin(int width_px, int height_px);

  /// Copies the viewport's pixels to `matte`: width * height bytes, the row of window y = 0 first. Waits for drawing to
  /// end.
  void read(int width_px, int height_px, std::uint8_t* matte) const;

 private:
  gl::FramebufferHandle framebuffer_;
  gl::RenderbufferHandle coverage_;
  int width_px_ = 0;
  int height_px_ = 0;
};

}  // namespace rinkaku::silhouette
