#pragma once

#include <string>

#include "pipeline/frame/frame.h"

namespace rinkaku::app {

/// Throws Error (Input) if a PNG can't be written under this name: it is no PNG's name, exists without `force`, or is
/// the input itself.
void check_picture_file(const std::string& picture, const std::string& input, bool force);

/// Writes a frame of 8-bit RGBA as a PNG.
void write_picture_file(const Frame& frame, const std::string& picture, bool force);

/// Throws Error (Input) if the output is the input.
void refuse_own_input(const std::string& output, const std::string& input);

}  // namespace rinkaku::app
