#pragma once

#include <filesystem>

#include "mesh/mesh.h"

namespace rinkaku::pipeline {

/// Reads a picture of a stroke, PNG or another kind that OpenCV knows: how much ink lies where, the stroke running from
/// left to right. Where the picture has alpha, ink is alpha; else it is how dark the picture is. The result holds it in
/// alpha. Throws Error (Input) for a file that is no picture.
mesh::Texture read_stroke_image(const std::filesystem::path& file);

}  // namespace rinkaku::pipeline
