#include "pipeline/ffmpeg/number_pattern.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <regex>

#include "pipeline/frame/error.h"

namespace rinkaku::ffmpeg {

namespace fs = std::filesystem;

std::string NumberPattern::file_name(std::int64_t number) const {
  std::string digits_text = std::to_string(number);
  if (static_cast<int>(digits_text.size()) < digits) {
    digits_text.insert(0, static_cast<std::size_t>(digits) - digits_text.size(), '0');
  }
  return (fs::path(folder) / (prefix + digits_text + suffix)).string();
}

std::optional<std::int64_t> NumberPattern::number_of(const std::string& name) const {
  if (!name.starts_with(prefix) || !name.ends_with(suffix)) return {};
  if (name.size() <= prefix.size() + suffix.size()) return {};
  const char* begin = name.data() + prefix.size();
  const char* end = name.data() + name.size() - suffix.size();
  std::int64_t number = 0;
  const auto [rest, error] = std::from_chars(begin, end, number);
  if (error != std::errc() || rest != end || number < 0) return {};
  // "7.png" is no match for "%04d.png".
  if (fs::path(file_name(number)).filename() != name) return {};
  return number;
}

std::optional<NumberPattern> parse_number_pattern(const std::string& path) {
  const fs::path whole(path);
  const std::string name = whole.filename().string();
  static const std::regex number("%(0?)([0-9]?)d");
  std::smatch match;
  if (!std::regex_search(name, match, number)) return {};
  NumberPattern pattern{whole.parent_path().string(), match.prefix().str(), match.suffix().str(), 0};
  if (match[2].length() > 0) pattern.digits = std::stoi(match[2].str());
  if (std::regex_search(pattern.suffix, number)) return {};
  return pattern;
}

std::vector<std::int64_t> existing_numbers(const NumberPattern& pattern) {
  const fs::path folder = pattern.folder.empty() ? fs::path(".") : fs::path(pattern.folder);
  std::error_code error;
  std::vector<std::int64_t> numbers;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (const auto number = pattern.number_of(entry->path().filename().string())) numbers.push_back(*number);
  }
  if (error) throw input_error(folder.string(), "the folder can't be read: " + error.message(), "check the path");
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

}  // namespace rinkaku::ffmpeg
