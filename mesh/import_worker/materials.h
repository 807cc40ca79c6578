#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <assimp/scene.h>

#include "mesh/mesh.h"

namespace rinkaku::mesh {

/// sRGB encoding of a linear value (IEC 61966-2-1); clamped to 0 .. 1.
float srgb_from_linear(float linear);

/// Decodes each texture that is asked for once; those that can't be had become a warning.
class TextureReader {
 public:
  /// `scene` may hold textures itself (nullptr: there are none); others lie in `folder`.
  TextureReader(const aiScene* scene, std::filesystem::path folder);

  /// The texture's index in `textures`, or -1.
  int number_of(const std::string& name);
  /// The same of a picture's file in memory, under a name of its own.
  int number_of(const std::string& name, std::span<const char> picture);

  std::vector<Texture> textures;
  std::vector<std::string> warnings;

 private:
  int keep(const std::string& name, bool decoded, Texture&& texture, const std::string& why);
  bool decode(const std::string& name, Texture& out, std::string& why) const;

  const aiScene* scene_;
  std::filesystem::path folder_;
  std::map<std::string, int> by_name_;
};

/// Turns one of Assimp's materials into ours. `linear_factors`: the format's colour factors are linear (glTF), not
/// sRGB-encoded.
Material read_material(const aiMaterial& material, bool linear_factors, TextureReader& textures);

/// Which set of texture coordinates the material's texture uses.
unsigned uv_channel(const aiMaterial& material);

}  // namespace rinkaku::mesh
