#pragma once

#include <filesystem>

namespace rinkaku::report {

/// A folder of its own in the system's place for temporary files, gone with all that is in it at the end.
class ScratchFolder {
 public:
  /// Throws Error (Runtime) if none can be made.
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace rinkaku::report
