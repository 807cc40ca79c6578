#pragma once

#include <string>

#include "pipeline/frame/frame.h"
#include "pipeline/matte/score.h"

namespace rinkaku::app {

/// Reads a matte from a picture file: its alpha channel if it has one, else its grey values; 8 to 16 bits.
/// Throws Error (Input) naming the file if it can't be read or is in colour without alpha.
matte::GreyMatte read_grey(const std::string& path);

/// A frame of a video of mattes likewise, but that colour is taken by its brightness (of RGB: the red).
matte::GreyMatte grey_of(const Frame& frame);

}  // namespace rinkaku::app
