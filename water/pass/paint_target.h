#pragma once

#include "pipeline/gl/handle.h"

namespace rinkaku::water {

/// A picture that strokes are painted into and that is then sampled: RGBA8, premultiplied. Grows to the largest size
/// asked for. Needs a current GL context.
class PaintTarget {
 public:
  PaintTarget();
  /// Binds it with a viewport of this size, cleared to nothing.
  void begin(int width_px, int height_px);
  GLuint texture() const { return texture_.name(); }

 private:
  gl::FramebufferHandle framebuffer_;
  gl::TextureHandle texture_;
  int width_px_ = 0, height_px_ = 0;
};

}  // namespace rinkaku::water
