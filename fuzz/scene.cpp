// Whatever bytes a scene file holds, reading it ends in a scene or in an Error. The files that scenes of the corpus
// name are there, so that what lies behind them is reached.
#include "pipeline/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

#include "pipeline/frame/error.h"

namespace {

namespace fs = std::filesystem;

class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("rinkaku_fuzz_" + std::to_string(getpid()))) {
    fs::create_directories(path_);
    for (const char* name : {"v.mp4", "c.yml", "m.obj", "b.toml", "p.csv"}) std::ofstream(path_ / name) << "x";
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  fs::path holding(const std::uint8_t* data, std::size_t size) const {
    const fs::path file = path_ / "scene.toml";
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    return file;
  }

 private:
  fs::path path_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  try {
    rinkaku::pipeline::read_scene(folder.holding(data, size));
  } catch (const rinkaku::Error&) {
  }
  return 0;
}
