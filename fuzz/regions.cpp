// Whatever bytes a region file holds, reading it ends in lists whose indices are in range, or in an Error: never in a
// crash, a hang, or memory out of proportion. For libFuzzer; built without the file's sums, which no fuzzer can guess.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "pipeline/frame/error.h"
#include "silhouette/region_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rinkaku;
  using namespace rinkaku::silhouette;
  try {
    const RegionFile file = RegionFile::from_memory({data, data + size}, "fuzz");
    const RegionFinder finder(file.space());
    if (const auto region = finder.find({2, 0.5, 0.25}); region && *region >= file.regions()) std::abort();
    std::vector<std::uint32_t> list;
    const std::vector<glm::uvec3> triangles(std::min<std::size_t>(file.mesh_triangles(), 100'000), glm::uvec3(0));
    const std::uint32_t step = std::max(1u, file.regions() / 32);
    for (std::uint32_t region = 0; region < file.regions(); region += step) {
      for (const Product product : {Product::Matte, Product::Depth, Product::Colour}) {
        try {
          if (product == Product::Colour) {
            file.decode_colour(region, triangles, list);
            continue;
          }
          file.decode(region, product, list);
        } catch (const Error&) {
          continue;
        }
        if (list.size() != std::size_t{file.triangles(region, product)} * 3) std::abort();
        if (std::any_of(list.begin(), list.end(), [&](std::uint32_t i) { return i >= file.points(); })) std::abort();
      }
    }
  } catch (const Error&) {
  }
  return 0;
}
