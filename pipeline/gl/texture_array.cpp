#include "pipeline/gl/texture_array.h"

#include <algorithm>
#include <bit>
#include <string>

#include "pipeline/frame/error.h"
#include "pipeline/gl/count.h"

namespace rinkaku::gl {

TextureArray::TextureArray(int width_px, int height_px, int layers, std::span<const std::uint8_t> rgba) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &name);
  handle_ = TextureHandle(name);
  ++counters().textures;
  const int levels = std::bit_width(static_cast<unsigned>(std::max(width_px, height_px)));
  glTextureStorage3D(name, levels, GL_RGBA8, width_px, height_px, layers);
  if (glGetError() != GL_NO_ERROR) {
    throw runtime_failure("OpenGL",
                          "there is no memory for " + std::to_string(layers) + " textures of " +
                              std::to_string(width_px) + "x" + std::to_string(height_px) + " texels",
                          "make the texture smaller");
  }
  glTextureSubImage3D(name, 0, 0, 0, 0, width_px, height_px, layers, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  glGenerateTextureMipmap(name);
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

}  // namespace rinkaku::gl
