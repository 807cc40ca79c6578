#include "pipeline/objects/texture_file.h"

#include <cstddef>
#include <cstring>

#include "pipeline/source/picture_file.h"

namespace rinkaku::pipeline {
namespace {

constexpr std::size_t channels = 4;

bool is_opaque(const mesh::Texture& texture) {
  for (std::size_t i = channels - 1; i < texture.rgba.size(); i += channels) {
    if (texture.rgba[i] != 255) return false;
  }
  return true;
}

// Rec. 601's weights, in 1/256.
std::uint8_t grey_of(const std::uint8_t* rgb) {
  return static_cast<std::uint8_t>((77 * rgb[0] + 150 * rgb[1] + 29 * rgb[2] + 128) >> 8);
}

}  // namespace

mesh::Texture read_texture(const std::filesystem::path& file) {
  const Frame frame = source::to_rgba(source::read_picture(file.string()));
  const Plane& plane = frame.planes[0];
  mesh::Texture texture;
  texture.width_px = frame.format.width_px;
  texture.height_px = frame.format.height_px;
  const std::size_t row = static_cast<std::size_t>(texture.width_px) * channels;
  texture.rgba.resize(row * static_cast<std::size_t>(texture.height_px));
  for (int y = 0; y < texture.height_px; ++y) {
    std::memcpy(texture.rgba.data() + static_cast<std::size_t>(y) * row, plane.data + y * plane.stride_bytes, row);
  }
  return texture;
}

mesh::Texture read_stroke_image(const std::filesystem::path& file) {
  mesh::Texture image = read_texture(file);
  const bool opaque = is_opaque(image);
  for (std::size_t i = 0; i < image.rgba.size(); i += channels) {
    std::uint8_t* pixel = image.rgba.data() + i;
    if (opaque) pixel[3] = static_cast<std::uint8_t>(255 - grey_of(pixel));
    pixel[0] = pixel[1] = pixel[2] = 0;
  }
  return image;
}

}  // namespace rinkaku::pipeline
