#include "pipeline/gl/shader_text.h"

#include <system_error>
#include <utility>

#include "pipeline/files/read_file.h"

namespace rinkaku::gl {
namespace {

std::filesystem::path& folder() {
  static std::filesystem::path path;
  return path;
}

// A part that was built in begins with a comment that names its file.
std::string_view file_of(std::string_view built_in) {
  constexpr std::string_view mark = "// ";
  if (!built_in.starts_with(mark)) return {};
  return built_in.substr(mark.size(), built_in.find('\n') - mark.size());
}

}  // namespace

void use_shaders_from(std::filesystem::path path) { folder() = std::move(path); }

bool is_shader_file(const std::filesystem::path& file) {
  for (const char* ending : {".vert", ".frag", ".comp", ".glsl"}) {
    if (file.extension() == ending) return true;
  }
  return false;
}

std::string shader_text(std::string_view built_in) {
  const std::string_view name = file_of(built_in);
  if (folder().empty() || name.empty()) return std::string(built_in);
  const std::filesystem::path path = folder() / name;
  std::error_code absent;
  if (!std::filesystem::is_regular_file(path, absent)) return std::string(built_in);
  constexpr std::size_t most_bytes = 1 << 20;
  return files::read_file(path, most_bytes);
}

}  // namespace rinkaku::gl
