#include "pipeline/gl/texture.h"

#include <algorithm>
#include <bit>

#include "pipeline/gl/count.h"

namespace rinkaku::gl {
namespace {

GLuint create() {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &name);
  ++counters().textures;
  return name;
}

}  // namespace

Texture::Texture(int width_px, int height_px, std::span<const std::uint8_t> rgba) : handle_(create()) {
  const int levels = std::bit_width(static_cast<unsigned>(std::max(width_px, height_px)));
  glTextureStorage2D(handle_.name(), levels, GL_RGBA8, width_px, height_px);
  glTextureSubImage2D(handle_.name(), 0, 0, 0, width_px, height_px, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  glGenerateTextureMipmap(handle_.name());
  glTextureParameteri(handle_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(handle_.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

}  // namespace rinkaku::gl
