// Whatever bytes a VRM holds, what its materials say about outlines is read or passed over.
#include "mesh/import_worker/mtoon.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const rinkaku::mesh::MtoonLines lines(std::span(reinterpret_cast<const char*>(data), size));
  rinkaku::mesh::TextureReader textures(nullptr, {});
  for (const unsigned material : {0u, 1u}) {
    std::optional<rinkaku::mesh::MaterialLine> line = lines.of(material, "skin");
    if (line) lines.read_width_texture(*line, textures);
  }
  return 0;
}
