#pragma once

#include <cstdint>

#include "pipeline/gl/handle.h"

namespace rinkaku::gl {

/// What is drawn into, one sample a pixel. Grows to the largest size asked for. Needs a current GL context.
class Target {
 public:
  enum class Kind {
    Picture,  ///< RGBA8 colour (premultiplied) and 32-bit float depth
    Matte,    ///< one 8-bit channel, no depth
  };
  explicit Target(Kind kind = Kind::Picture);

  /// Binds the target with a viewport of width x height at its origin, cleared to nothing: colour 0, depth 0 (depth is
  /// reversed: 1 at the near plane, 0 infinitely far), or `depth`. Throws Error (Runtime) if the driver does not draw
  /// pictures of this size.
  void begin(int width_px, int height_px, double depth = 0);

  /// Copies the viewport's pixels to `pixels`: width * height times 4 bytes (Picture) or 1 (Matte), the row of window
  /// y = 0 first. Waits for drawing to end.
  void read(int width_px, int height_px, std::uint8_t* pixels) const;
  /// The same for depth, of a Picture: one float a pixel, as the depth function saw it.
  void read_depth(int width_px, int height_px, float* depth) const;
  /// The texture that depth is in, of a Picture: as large as the viewport or larger, at the same origin.
  GLuint depth_texture() const { return depth_.name(); }

 private:
  Kind kind_;
  FramebufferHandle framebuffer_;
  RenderbufferHandle colour_;
  TextureHandle depth_;
  int width_px_ = 0;
  int height_px_ = 0;
};

}  // namespace rinkaku::gl
