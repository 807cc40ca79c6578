// Whatever bytes an OFF file holds, reading it ends in triangles or in an ImportFailure.
#include <cstddef>
#include <cstdint>

#include "fuzz/in_memory_file.h"
#include "mesh/import_message.h"
#include "mesh/import_worker/read_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static rinkaku::fuzz::InMemoryFile file;
  try {
    rinkaku::mesh::read_off(file.holding(data, size), true);
  } catch (const rinkaku::mesh::ImportFailure&) {
  }
  return 0;
}
