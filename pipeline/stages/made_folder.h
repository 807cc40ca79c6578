#pragma once

#include <filesystem>
#include <vector>

namespace rinkaku::pipeline {

/// A folder that is made where it is missing, and taken away again if nothing is left in it at the end.
class MadeFolder {
 public:
  /// Throws Error (Input) if it can't be made.
  explicit MadeFolder(const std::filesystem::path& folder);
  ~MadeFolder();
  MadeFolder(const MadeFolder&) = delete;
  MadeFolder& operator=(const MadeFolder&) = delete;

 private:
  std::vector<std::filesystem::path> made_;  // innermost first
};

}  // namespace rinkaku::pipeline
