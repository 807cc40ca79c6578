#include "mesh/import_worker/read_file.h"

#include <algorithm>
#include <cctype>

namespace rinkaku::mesh {

std::string lower_ending(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

ReadScene read_file(const std::filesystem::path& file, ImportOptions::Normals normals, bool rig) {
  const std::string ending = lower_ending(file);
  const bool keep_normals = normals == ImportOptions::Normals::File;
  if (ending == ".ply") return read_ply(file, keep_normals);
  if (ending == ".off") return read_off(file, keep_normals);
  return read_with_assimp(file, normals, rig);
}

}  // namespace rinkaku::mesh
