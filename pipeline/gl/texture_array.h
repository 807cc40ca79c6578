#pragma once

#include <cstdint>
#include <span>

#include "pipeline/gl/handle.h"

namespace rinkaku::gl {

/// RGBA8 pictures of one size to sample from as one texture: mipmapped, trilinear, repeating.
class TextureArray {
 public:
  TextureArray() = default;
  /// `rgba`: width * height * 4 bytes a layer, rows from the top, one layer after the other. Texels are averaged as
  /// they are, so transparent ones should be premultiplied. Throws Error (Runtime) if the driver takes no texture so
  /// large.
  TextureArray(int width_px, int height_px, int layers, std::span<const std::uint8_t> rgba);
  GLuint name() const { return handle_.name(); }

 private:
  TextureHandle handle_;
};

}  // namespace rinkaku::gl
