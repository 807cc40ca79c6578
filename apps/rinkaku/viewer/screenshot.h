#pragma once

#include <string>

#include "pipeline/frame/frame.h"

namespace rinkaku::app {

/// Writes the frame as a PNG in its own size under the first free name rinkaku_000001.png, ... of the folder, and
/// returns that name. Throws Error if it can't be written.
std::string save_screenshot(const Frame& frame, const std::string& folder);

}  // namespace rinkaku::app
