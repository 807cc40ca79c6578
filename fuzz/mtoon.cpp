// Whatever bytes a VRM holds, what its materials say about outlines is read or passed over.
#include "mesh/import_worker/mtoon.h"

#include <cstddef>
#include <cstdint>
#include <span>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const rinkaku::mesh::MtoonLines lines(std::span(reinterpret_cast<const char*>(data), size));
  rinkaku::mesh::TextureReader textures(nullptr, {});
  for (const unsigned material : {0u, 1u}) {
    rinkaku::mesh::Material read;
    read.name = "skin";
    lines.read_line(material, read, textures);
  }
  return 0;
}
