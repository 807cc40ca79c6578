#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesh/import_worker/materials.h"
#include "mesh/mesh.h"

namespace rinkaku::mesh {

/// The outlines that a VRM's or GLB's materials ask for: MToon's values, of VRM 0.x (`materialProperties`, centimetres
/// and hundredths of half the picture's height) and VRM 1.0 (`VRMC_materials_mtoon`, metres and the picture's height).
class MtoonLines {
 public:
  MtoonLines() = default;
  /// Of a whole binary glTF. Nothing is found in what isn't one, and in values that make no sense. Throws nothing.
  explicit MtoonLines(std::span<const char> glb);

  /// Gives the material that Assimp has at `index` its line, if the file says anything about it; Assimp numbers
  /// materials in the order of their use, so its name counts as well. Decodes the line's width texture, if it lies in
  /// the file; what of it can't be followed becomes a warning.
  void read_line(unsigned index, Material& material, TextureReader& textures) const;

 private:
  struct Named {
    std::string name;
    std::optional<MaterialLine> line;  // with the file's own number of the width texture
    std::string warning;
  };
  const Named* find(unsigned index, const std::string& name) const;

  std::vector<Named> materials_;               // as the file numbers them
  std::map<int, std::vector<char>> pictures_;  // of width textures, by the file's number
};

}  // namespace rinkaku::mesh
