#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rinkaku::ffmpeg {

/// The parts of a file name with one printf number, e.g. "out/a%04d.png": folder "out", prefix "a", suffix ".png".
struct NumberPattern {
  std::string folder;  ///< empty for the current one
  std::string prefix;
  std::string suffix;
  int digits = 0;  ///< at least as many, filled up with zeros; 0 for as many as needed

  std::string file_name(std::int64_t number) const;  ///< with the folder
  /// The number of a name without its folder: 12 of "a0012.png"; empty if it is none of the pattern's.
  std::optional<std::int64_t> number_of(const std::string& name) const;
};

/// Empty if the last part of the path holds not exactly one %d, %Nd or %0Nd ("%%" is no percent sign here).
std::optional<NumberPattern> parse_number_pattern(const std::string& path);

/// The numbers for which a file exists, rising. Throws Error (Input) if the folder can't be read.
std::vector<std::int64_t> existing_numbers(const NumberPattern& pattern);

}  // namespace rinkaku::ffmpeg
