#include "mesh/import_worker/read_file.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <memory>

#include "mesh/import_message.h"

namespace rinkaku::mesh {

std::vector<char> read_bytes(const std::filesystem::path& file) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> opened(std::fopen(file.c_str(), "rbe"), std::fclose);
  if (!opened) throw ImportFailure{"it can't be opened", "check its permissions"};
  std::vector<char> bytes(static_cast<std::size_t>(std::filesystem::file_size(file)));
  bytes.resize(std::fread(bytes.data(), 1, bytes.size(), opened.get()));
  return bytes;
}

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
