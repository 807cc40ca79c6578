#pragma once

#include <filesystem>

#include "mesh/mesh.h"

namespace rinkaku::pipeline {

/// Reads a PNG, JPEG, TIFF or WebP picture as a texture: 8-bit RGBA, straight alpha, sRGB.
/// Throws Error (Input) naming the file if it can't be read.
mesh::Texture read_picture(const std::filesystem::path& file);

}  // namespace rinkaku::pipeline
