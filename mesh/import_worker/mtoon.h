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

  /// Of the material that Assimp has at `index` under a name; it numbers them in the order of their use. Width
  /// textures are still the file's own numbers; read_width_texture() makes them the mesh's.
  std::optional<MaterialLine> of(unsigned index, const std::string& name) const;
  /// Decodes the picture, if the line has one that lies in the file.
  void read_width_texture(MaterialLine& line, TextureReader& textures) const;

 private:
  struct Named {
    std::string name;
    std::optional<MaterialLine> line;
  };
  std::vector<Named> materials_;               // as the file numbers them
  std::map<int, std::vector<char>> pictures_;  // of width textures, by the file's number
};

}  // namespace rinkaku::mesh
