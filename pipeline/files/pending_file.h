#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace rinkaku::files {

/// When a file bears its name: once it is whole, or, for recordings that are worth having even cut short, from the
/// start.
enum class Appears { WhenWhole, AtOnce };

/// A file that is written under a hidden temporary name beside its final one and gets that when it is whole.
/// Removed if it never becomes whole. Standard output ("-"), devices and pipes are written directly.
class PendingFile {
 public:
  /// Creates nothing yet. Throws Error (Input) if `path` can't be an output: exists already and not `overwrite`, is a
  /// folder, lies in a folder that doesn't exist or can't be written, or is the very file `input` (empty: no such
  /// check). One that appears at once isn't removed either.
  PendingFile(const std::string& path, bool overwrite, const std::string& input = {},
              Appears appears = Appears::WhenWhole);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  /// Throws Error (Input) if `other` is the same file, or would be.
  void must_not_be(const std::string& other) const;

  /// Where to write; "-" is standard output.
  const std::string& open_path() const { return temporary_.empty() ? final_ : temporary_; }
  const std::string& path() const { return final_; }

  /// Puts the closed file under its final name. Throws Error (Runtime) if that fails.
  void commit();

  /// Writes all that the file is to hold, and commits. Throws Error: Input if it can't be opened, Runtime if the disk
  /// is full or fails.
  void write(std::string_view bytes);
  void write(std::span<const std::uint8_t> bytes);

 private:
  std::string final_;
  std::string temporary_;  ///< empty when written directly
};

/// Writes a whole file in one go, over what is there.
void write_file(const std::string& path, std::string_view bytes);

}  // namespace rinkaku::files
