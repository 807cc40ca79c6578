#pragma once

#include <string>

#include "pipeline/files/pending_file.h"

namespace rinkaku::sink {

/// Where to write the file, as FFmpeg's URL.
std::string output_url(const files::PendingFile& file);

/// Throws what a failed opening or writing of `path` deserves: `code` is FFmpeg's. `opening` makes it Error (Input).
[[noreturn]] void throw_write_error(const std::string& path, int code, bool opening = false);

}  // namespace rinkaku::sink
