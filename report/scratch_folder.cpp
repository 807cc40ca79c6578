#include "report/scratch_folder.h"

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include "pipeline/frame/error.h"

namespace rinkaku::report {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder() {
  std::error_code none;
  std::string name = (fs::temp_directory_path(none) / "rinkaku_report_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw runtime_failure(name, "can't be made (" + std::generic_category().message(errno) + ")",
                          "set TMPDIR to a folder with room in it");
  }
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace rinkaku::report
