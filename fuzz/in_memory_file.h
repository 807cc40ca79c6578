#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace rinkaku::fuzz {

/// A file that lies in memory, for readers that take a path. Its path stays the same, and so does its folder's content.
class InMemoryFile {
 public:
  InMemoryFile();
  ~InMemoryFile();
  InMemoryFile(const InMemoryFile&) = delete;
  InMemoryFile& operator=(const InMemoryFile&) = delete;

  const std::filesystem::path& holding(const std::uint8_t* data, std::size_t size);

 private:
  int descriptor_;
  std::filesystem::path path_;
};

}  // namespace rinkaku::fuzz
