#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace rinkaku::track {

/// A whole file's bytes. Throws Error (Input) naming the file if it is missing, a folder, not readable, or larger than
/// `most_bytes`.
std::string read_text_file(const std::filesystem::path& file, std::size_t most_bytes);

/// Writes a file whole: under another name beside it first, then renamed. Throws Error (Runtime) naming the file.
void write_text_file(const std::filesystem::path& file, std::string_view text);

}  // namespace rinkaku::track
