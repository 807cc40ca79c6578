#include "pipeline/gl/texture.h"

#include <algorithm>
#include <bit>
#include <string>
#include <vector>

#include "pipeline/frame/error.h"
#include "pipeline/gl/count.h"

namespace rinkaku::gl {
namespace {

GLuint create() {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &name);
  ++counters().textures;
  return name;
}

struct Texels {
  int width_px = 0;
  int height_px = 0;
  std::span<const std::uint8_t> rgba;
};

// Two texels become their mean, along x or along y. A last one without a neighbour stays as it is.
std::vector<std::uint8_t> halved(const Texels& from, bool along_x) {
  const int width = along_x ? (from.width_px + 1) / 2 : from.width_px;
  const int height = along_x ? from.height_px : (from.height_px + 1) / 2;
  std::vector<std::uint8_t> to(static_cast<std::size_t>(width) * height * 4);
  const auto texel = [&](int x, int y) {
    return from.rgba.data() + (static_cast<std::size_t>(y) * from.width_px + x) * 4;
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int x0 = along_x ? 2 * x : x, y0 = along_x ? y : 2 * y;
      const std::uint8_t* a = texel(x0, y0);
      const std::uint8_t* b =
          along_x ? texel(std::min(x0 + 1, from.width_px - 1), y0) : texel(x0, std::min(y0 + 1, from.height_px - 1));
      for (int c = 0; c < 4; ++c) {
        to[(static_cast<std::size_t>(y) * width + x) * 4 + c] = static_cast<std::uint8_t>((a[c] + b[c] + 1) / 2);
      }
    }
  }
  return to;
}

void upload(GLuint name, const Texels& texels) {
  const int levels = std::bit_width(static_cast<unsigned>(std::max(texels.width_px, texels.height_px)));
  glTextureStorage2D(name, levels, GL_RGBA8, texels.width_px, texels.height_px);
  if (glGetError() != GL_NO_ERROR) {
    throw runtime_failure("OpenGL",
                          "there is no memory for a texture of " + std::to_string(texels.width_px) + "x" +
                              std::to_string(texels.height_px) + " texels",
                          "make the mesh's textures smaller");
  }
  glTextureSubImage2D(name, 0, 0, 0, texels.width_px, texels.height_px, GL_RGBA, GL_UNSIGNED_BYTE, texels.rgba.data());
}

}  // namespace

TextureHandle texel_storage(GLenum format, int width_px, int height_px) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &name);
  TextureHandle handle(name);
  glTextureStorage2D(name, 1, format, width_px, height_px);
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return handle;
}

Texture::Texture(int width_px, int height_px, std::span<const std::uint8_t> rgba) : handle_(create()) {
  GLint most_px = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most_px);
  Texels texels{width_px, height_px, rgba};
  std::vector<std::uint8_t> smaller;
  while (texels.width_px > most_px || texels.height_px > most_px) {
    const bool along_x = texels.width_px > most_px;
    smaller = halved(texels, along_x);
    int& side_px = along_x ? texels.width_px : texels.height_px;
    side_px = (side_px + 1) / 2;
    texels.rgba = smaller;
  }
  upload(handle_.name(), texels);
  glGenerateTextureMipmap(handle_.name());
  glTextureParameteri(handle_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(handle_.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

}  // namespace rinkaku::gl
