#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace rinkaku::gl {

/// From now on programs are made of the files in this folder where it has them, e.g. FOLDER/outline/pass/hull.frag for
/// what the sources have there, and of what was built in where it doesn't. Empty: only of what was built in. Call it
/// before any program is made.
void use_shaders_from(std::filesystem::path folder);

/// By its ending.
bool is_shader_file(const std::filesystem::path& file);

/// The text that goes to the compiler for a part built in. Throws Error (Input) if its file can't be read.
std::string shader_text(std::string_view built_in);

}  // namespace rinkaku::gl
