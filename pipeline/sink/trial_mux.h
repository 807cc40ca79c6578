#pragma once

#include <string>

#include "pipeline/ffmpeg/handles.h"

namespace rinkaku::sink {

/// Whether a muxer writes a header for a file of this one stream: the only way to know what it takes. Empty if so, else
/// the muxer's complaint. Nothing is written anywhere.
std::string refusal(const AVOutputFormat& container, const AVStream& stream);

}  // namespace rinkaku::sink
