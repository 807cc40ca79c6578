#pragma once

#include <string>

#include "pipeline/frame/frame.h"

namespace rinkaku::source {

/// The one picture of an image file (PNG, JPEG, TIFF, WebP, ... or a video's first), as open() delivers it.
/// Throws Error (Input) naming the file if it can't be read or is damaged.
Frame read_picture(const std::string& path);

/// The same in 8-bit RGBA, straight alpha, in one plane. Throws as read_picture() does.
Frame read_rgba(const std::string& path);

}  // namespace rinkaku::source
