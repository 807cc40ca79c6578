#include <cstdio>
#include <memory>

#include "mesh/import_message.h"
#include "mesh/import_worker/read_file.h"

namespace rinkaku::mesh {

std::vector<char> read_bytes(const std::filesystem::path& file) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> opened(std::fopen(file.c_str(), "rbe"), std::fclose);
  if (!opened) throw ImportFailure{"it can't be opened", "check its permissions"};
  std::vector<char> bytes(static_cast<std::size_t>(std::filesystem::file_size(file)));
  bytes.resize(std::fread(bytes.data(), 1, bytes.size(), opened.get()));
  return bytes;
}

}  // namespace rinkaku::mesh
