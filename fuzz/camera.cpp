// Whatever bytes a camera file holds, reading it ends in a camera or in an Error.
#include <cstddef>
#include <cstdint>

#include "fuzz/in_memory_file.h"
#include "pipeline/frame/error.h"
#include "pipeline/track/camera_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static rinkaku::fuzz::InMemoryFile file;
  try {
    rinkaku::track::read_camera(file.holding(data, size));
  } catch (const rinkaku::Error&) {
  }
  return 0;
}
