#pragma once

#include <filesystem>
#include <string>

#include "report/section.h"

namespace rinkaku::report {

/// A file of a recording that the project ships, as "desk/video.mp4". Throws Error (Input) if it isn't there.
std::filesystem::path recorded(const Settings& settings, const std::string& file);

}  // namespace rinkaku::report
