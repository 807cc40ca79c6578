#include "pipeline/gl/shader_text.h"

#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "pipeline/frame/error.h"

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
  std::ifstream file(path);
  std::string text((std::istreambuf_iterator<char>(file)), {});
  if (!file) throw runtime_failure(path.string(), "can't be read", "check its permissions");
  return text;
}

}  // namespace rinkaku::gl
