#pragma once

#include <string>

#include "pipeline/frame/frame.h"

namespace rinkaku::source {

/// The one picture of an image file (PNG, JPEG, TIFF, WebP, ... or a video's first), as open() delivers it.
/// Throws Error (Input) naming the file if it can't be read or is damaged.
Frame read_picture(const std::string& path);

/// A frame in 8-bit RGBA, straight alpha, in one plane. Throws Error (Input) if such frames can't be converted.
Frame to_rgba(const Frame& frame);

}  // namespace rinkaku::source
