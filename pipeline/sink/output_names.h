#pragma once

#include <string>
#include <vector>

namespace rinkaku::sink {

/// What the name of an output (Options::path) stands for, before anything is opened.

/// Whether it is a printf pattern of numbered files.
bool is_sequence(const std::string& output);

/// The files that exist under that name: one at most, or those of a sequence. Throws Error (Input) if the sequence's
/// folder can't be read.
std::vector<std::string> existing_files(const std::string& output);

/// Whether two outputs of one run would write the same file, by the real names of their folders.
bool share_a_file(const std::string& one, const std::string& other);

}  // namespace rinkaku::sink
