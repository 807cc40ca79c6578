#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace rinkaku::mesh {

/// The outlines that a VRM's or GLB's materials ask for: MToon's values, of VRM 0.x (`materialProperties`, centimetres
/// and hundredths of half the picture's height) and VRM 1.0 (`VRMC_materials_mtoon`, metres and the picture's height).
class MtoonLines {
 public:
  MtoonLines() = default;
  /// Of a whole binary glTF. Nothing is found in what isn't one, and in values that make no sense. Throws nothing.
  explicit MtoonLines(std::span<const char> glb);

  /// Of the material that Assimp has at `index` under a name; it numbers them in the order of their use.
  std::optional<MaterialLine> of(unsigned index, const std::string& name) const;

 private:
  struct Named {
    std::string name;
    std::optional<MaterialLine> line;
  };
  std::vector<Named> materials_;  // as the file numbers them
};

}  // namespace rinkaku::mesh
