#pragma once

#include <string>

#include "pipeline/matte/score.h"

namespace rinkaku::app {

/// Reads a matte from a picture file: its alpha channel if it has one, else its grey values; 8 or 16 bits.
/// Throws Error (Input) naming the file if it can't be read or is in colour without alpha.
matte::GreyMatte read_grey(const std::string& path);

/// An 8-bit grey PNG's bytes. `grey`: width * height values, rows from the top. Throws Error (Runtime) naming `path`.
std::string png_bytes(const std::string& path, int width_px, int height_px, const std::uint8_t* grey);

}  // namespace rinkaku::app
