#include "pipeline/files/read_file.h"

#include <cerrno>
#include <fstream>
#include <system_error>

#include "pipeline/frame/error.h"

namespace rinkaku::files {

std::string read_file(const std::filesystem::path& file, std::size_t most_bytes) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found) throw input_error(file.string(), "no such file");
  if (std::filesystem::is_directory(status)) throw input_error(file.string(), "is a folder", "name a file in it");
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    throw input_error(file.string(), "can't be read: " + std::generic_category().message(errno),
                      "check its permissions");
  }
  std::string text;
  char buffer[1 << 14];
  while (in.read(buffer, sizeof buffer) || in.gcount() > 0) {
    text.append(buffer, static_cast<std::size_t>(in.gcount()));
    if (text.size() > most_bytes) {
      throw input_error(file.string(), "is too large to be what it should be",
                        "at most " + std::to_string(most_bytes >> 20) + " MiB are read");
    }
  }
  if (in.bad()) throw input_error(file.string(), "can't be read to its end");
  return text;
}

}  // namespace rinkaku::files
