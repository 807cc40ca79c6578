#include "pipeline/stages/made_folder.h"

#include <system_error>

#include "pipeline/frame/error.h"

namespace rinkaku::pipeline {

namespace fs = std::filesystem;

MadeFolder::MadeFolder(const fs::path& folder) {
  std::error_code error;
  for (fs::path missing = fs::absolute(folder).lexically_normal(); !fs::exists(missing, error);
       missing = missing.parent_path()) {
    if (!missing.filename().empty()) made_.push_back(missing);
    if (missing == missing.root_path()) break;
  }
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder)) {
    const std::string why = error ? error.message() : "it is a file";
    throw input_error(folder.string(), "this folder can't be made (" + why + ")",
                      "give the name of a folder that you may write to");
  }
}

MadeFolder::~MadeFolder() {
  std::error_code not_empty;
  for (const fs::path& folder : made_) fs::remove(folder, not_empty);
}

}  // namespace rinkaku::pipeline
