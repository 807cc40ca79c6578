#pragma once

#include <string>

namespace rinkaku::sink {

/// A file that is written under a hidden temporary name beside its final one and gets that when it is whole.
/// Removed if it never becomes whole. Standard output ("-"), devices and pipes are written directly.
class PendingFile {
 public:
  /// Throws Error (Input) if `path` can't be an output: exists already and not `overwrite`, is a folder, lies in a
  /// folder that doesn't exist or can't be written, or is the very file `input` (empty: no such check).
  PendingFile(const std::string& path, bool overwrite, const std::string& input = {});
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  /// What to open for writing, as FFmpeg's URL.
  const std::string& url() const { return url_; }
  const std::string& path() const { return final_; }

  /// Puts the closed file under its final name. Throws Error (Runtime) if that fails.
  void commit();

 private:
  std::string final_;
  std::string temporary_;  ///< empty when written directly
  std::string url_;
};

/// Throws what a failed opening or writing of `path` deserves: `code` is FFmpeg's. `opening` makes it Error (Input).
[[noreturn]] void throw_write_error(const std::string& path, int code, bool opening = false);

}  // namespace rinkaku::sink
