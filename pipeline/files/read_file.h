#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace rinkaku::files {

/// A whole file's bytes. Throws Error (Input) naming the file if it is missing, a folder, not readable, or larger than
/// `most_bytes`.
std::string read_file(const std::filesystem::path& file, std::size_t most_bytes);

}  // namespace rinkaku::files
