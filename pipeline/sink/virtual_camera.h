#pragma once

#include <memory>
#include <string>

#include "pipeline/sink/sink.h"

namespace rinkaku::sink {

/// Opens a video output device (v4l2loopback, or hardware), which other programs read as a camera.
///
/// Frames are written as YUYV in limited range: planar 8-bit 4:2:2 as it is, 4:2:0 with its chroma rows doubled, all
/// else converted. What nobody reads is gone. Throws Error (Input) if there is no such device, or it takes no such
/// pictures.
std::unique_ptr<Sink> open_virtual_camera(const std::string& device, const Incoming& incoming);

}  // namespace rinkaku::sink
