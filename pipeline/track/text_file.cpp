#include "pipeline/track/text_file.h"

#include <fstream>
#include <iterator>
#include <system_error>

#include "pipeline/frame/error.h"

namespace rinkaku::track {

std::string read_text_file(const std::filesystem::path& file, std::size_t most_bytes) {
  std::error_code code;
  const auto status = std::filesystem::status(file, code);
  if (!std::filesystem::exists(status)) throw input_error(file.string(), "there is no such file");
  if (std::filesystem::is_directory(status)) throw input_error(file.string(), "this is a folder, not a file");
  std::ifstream in(file, std::ios::binary);
  if (!in) throw input_error(file.string(), "the file can't be read", "check its permissions");
  std::string text;
  char buffer[1 << 14];
  while (in.read(buffer, sizeof buffer) || in.gcount() > 0) {
    text.append(buffer, static_cast<std::size_t>(in.gcount()));
    if (text.size() > most_bytes) {
      throw input_error(file.string(), "the file is too large to be what it should be",
                        "at most " + std::to_string(most_bytes >> 20) + " MB are read");
    }
  }
  if (in.bad()) throw input_error(file.string(), "the file can't be read to its end");
  return text;
}

void write_text_file(const std::filesystem::path& file, std::string_view text) {
  std::filesystem::path part = file;
  part += ".part";
  std::error_code code;
  {
    std::ofstream out(part, std::ios::binary | std::ios::trunc);
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    out.close();
    if (!out) {
      std::filesystem::remove(part, code);
      throw runtime_failure(file.string(), "the file can't be written", "check the folder and the space left");
    }
  }
  std::filesystem::rename(part, file, code);
  if (code) {
    const std::string reason = code.message();
    std::filesystem::remove(part, code);
    throw runtime_failure(file.string(), "the file can't be put in its place: " + reason);
  }
}

}  // namespace rinkaku::track
