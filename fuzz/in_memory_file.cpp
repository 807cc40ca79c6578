#include "fuzz/in_memory_file.h"

#include <cstdlib>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

namespace rinkaku::fuzz {

InMemoryFile::InMemoryFile()
    : descriptor_(memfd_create("fuzz", 0)), path_("/proc/self/fd/" + std::to_string(descriptor_)) {}

InMemoryFile::~InMemoryFile() { close(descriptor_); }

const std::filesystem::path& InMemoryFile::holding(const std::uint8_t* data, std::size_t size) {
  if (ftruncate(descriptor_, 0) != 0) std::abort();
  if (size > 0 && pwrite(descriptor_, data, size, 0) != static_cast<ssize_t>(size)) std::abort();
  return path_;
}

}  // namespace rinkaku::fuzz
