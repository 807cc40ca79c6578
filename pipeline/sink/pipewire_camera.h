#pragma once

#include <memory>

#include "pipeline/sink/sink.h"

namespace rinkaku::sink {

/// A video source of the running PipeWire, named "rinkaku", which browsers and other programs read as a camera; YUYV,
/// see YuyvPacker. A reader gets the newest frame; without one, frames go nowhere. If PipeWire ends, notice() says so
/// and the rest goes on. Throws Error (Runtime) if none is running.
std::unique_ptr<Sink> open_pipewire_camera(const Incoming& incoming);

}  // namespace rinkaku::sink
