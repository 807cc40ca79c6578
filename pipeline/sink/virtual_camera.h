#pragma once

#include <memory>
#include <string>

#include "pipeline/sink/sink.h"

namespace rinkaku::sink {

/// Opens a video output device (v4l2loopback, or hardware), or "pipewire", which other programs read as a camera.
///
/// Frames go there as YUYV, see YuyvPacker. What nobody reads is gone. Throws Error (Input) if there is no such device,
/// or it takes no such pictures.
std::unique_ptr<Sink> open_virtual_camera(const std::string& device, const Incoming& incoming);

}  // namespace rinkaku::sink
