#pragma once

#include <filesystem>
#include <string>

namespace rinkaku::recordings {

/// Decodes the desk's video, finds the board with OpenCV alone and compares with the poses that were rendered. Returns
/// a few lines of text for people; throws Error (Runtime) if the recording does not hold what its README promises.
std::string check_desk(const std::filesystem::path& folder);

}  // namespace rinkaku::recordings
