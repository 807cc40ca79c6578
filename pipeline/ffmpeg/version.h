#pragma once

#include <string>

namespace rinkaku::ffmpeg {

/// The version of the FFmpeg libraries that run, e.g. "5.1.6".
std::string version();

}  // namespace rinkaku::ffmpeg
