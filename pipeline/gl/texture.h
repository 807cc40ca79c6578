#pragma once

#include <cstdint>
#include <span>

#include "pipeline/gl/handle.h"

namespace rinkaku::gl {

/// Memory for a texture of one level that is sampled texel by texel, without filter; what lies beside it is as its
/// border.
TextureHandle texel_storage(GLenum format, int width_px, int height_px);

/// An RGBA8 picture to sample from: mipmapped, trilinear, repeating.
class Texture {
 public:
  Texture() = default;
  /// `rgba`: width * height * 4 bytes, rows from the top. A side longer than the driver takes is halved until it fits;
  /// texture coordinates stay as they were. Throws Error (Runtime) if the driver has no memory for it.
  Texture(int width_px, int height_px, std::span<const std::uint8_t> rgba);
  GLuint name() const { return handle_.name(); }

 private:
  TextureHandle handle_;
};

}  // namespace rinkaku::gl
