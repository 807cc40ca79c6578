#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace rinkaku::app {

/// A small text output that appears under its name only when it is whole.
class WholeFile {
 public:
  /// Throws Error (Input) if the file exists (unless `overwrite`) or its folder can't be written to.
  WholeFile(std::filesystem::path path, bool overwrite);

  /// Throws Error (Input) if `other` is the same file.
  void must_not_be(const std::filesystem::path& other) const;

  /// Throws Error (Runtime) if writing fails.
  void write(std::string_view text) const;

 private:
  std::filesystem::path path_;
};

}  // namespace rinkaku::app
