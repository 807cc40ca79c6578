// Whatever bytes a board file holds, reading it ends in a board or in an Error.
#include "pipeline/track/board.h"

#include <cstddef>
#include <cstdint>

#include "fuzz/in_memory_file.h"
#include "pipeline/frame/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static rinkaku::fuzz::InMemoryFile file;
  try {
    rinkaku::track::read_board(file.holding(data, size));
  } catch (const rinkaku::Error&) {
  }
  return 0;
}
