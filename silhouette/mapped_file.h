#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace rinkaku::silhouette {

/// A file's bytes, memory-mapped for reading. Move-only.
class MappedFile {
 public:
  MappedFile() = default;
  /// Throws Error (Input) if the file can't be opened, is no regular file, or is empty.
  explicit MappedFile(const std::filesystem::path& path);
  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;
  ~MappedFile();

  std::span<const std::uint8_t> bytes() const { return {data_, size_}; }

 private:
  const std::uint8_t* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace rinkaku::silhouette
