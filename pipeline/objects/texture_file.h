#pragma once

#include <filesystem>

#include "mesh/mesh.h"

namespace rinkaku::pipeline {

/// Reads an image file (see source::read_picture) as a texture: 8-bit RGBA, straight alpha.
/// Throws Error (Input) naming the file if it can't be read.
mesh::Texture read_texture(const std::filesystem::path& file);

/// Reads a picture of a stroke: how much ink lies where, the stroke running from left to right. Where the picture has
/// alpha, ink is alpha; else it is how dark the picture is. The result holds it in alpha. Throws as read_texture().
mesh::Texture read_stroke_image(const std::filesystem::path& file);

}  // namespace rinkaku::pipeline
