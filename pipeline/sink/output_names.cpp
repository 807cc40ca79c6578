#include "pipeline/sink/output_names.h"

#include <cstdint>
#include <filesystem>
#include <optional>

#include "pipeline/ffmpeg/number_pattern.h"

namespace rinkaku::sink {
namespace {

namespace fs = std::filesystem;

fs::path real_path(const fs::path& path) {
  std::error_code error;
  const fs::path real = fs::weakly_canonical(fs::absolute(path, error), error);
  return error ? path : real;
}

// Whether `one` writes a file under a name of `other`'s.
bool writes_into(const std::string& one, const std::string& other) {
  const auto written = ffmpeg::parse_number_pattern(one), names = ffmpeg::parse_number_pattern(other);
  if (!names) return !written && real_path(one) == real_path(other);
  if (!written) return names->number_of(fs::path(one).filename().string()).has_value();
  // A name's length alone decides whether a pattern takes its digits; a hundred hours have ten million frames.
  for (std::int64_t number = 1; number <= 10'000'000; number *= 10) {
    if (names->number_of(fs::path(written->file_name(number)).filename().string())) return true;
  }
  return false;
}

}  // namespace

bool is_sequence(const std::string& output) { return ffmpeg::parse_number_pattern(output).has_value(); }

std::vector<std::string> existing_files(const std::string& output) {
  std::vector<std::string> files;
  std::error_code error;
  if (fs::exists(output, error)) files.push_back(output);
  const auto pattern = ffmpeg::parse_number_pattern(output);
  if (!pattern || !fs::is_directory(pattern->folder.empty() ? "." : pattern->folder, error)) return files;
  for (const std::int64_t number : existing_numbers(*pattern)) files.push_back(pattern->file_name(number));
  return files;
}

bool share_a_file(const std::string& one, const std::string& other) {
  if (real_path(fs::absolute(one).parent_path()) != real_path(fs::absolute(other).parent_path())) return false;
  return writes_into(one, other) || writes_into(other, one);
}

}  // namespace rinkaku::sink
