#include <cerrno>
#include <fstream>
#include <string>
#include <system_error>

#include <unistd.h>

#include "pipeline/frame/error.h"
#include "silhouette/region_file.h"

namespace rinkaku::silhouette {
namespace {

namespace fs = std::filesystem;

/// A file that is removed again unless it was put in place.
class PartFile {
 public:
  explicit PartFile(const fs::path& final_path) : final_(final_path) {
    const fs::path folder = final_.has_parent_path() ? final_.parent_path() : fs::path(".");
    part_ = folder / ("." + final_.filename().string() + "." + std::to_string(::getpid()) + ".part");
  }
  ~PartFile() {
    std::error_code ignored;
    if (!part_.empty()) fs::remove(part_, ignored);
  }
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  const fs::path& path() const { return part_; }

  void put_in_place() {
    std::error_code error;
    fs::rename(part_, final_, error);
    if (error) throw runtime_failure(final_.string(), "can't be put in place: " + error.message());
    part_.clear();
  }

 private:
  fs::path final_;
  fs::path part_;
};

}  // namespace

void save_region_file(std::span<const std::uint8_t> bytes, const fs::path& path) {
  PartFile part(path);
  std::ofstream stream(part.path(), std::ios::binary);
  if (!stream) {
    throw input_error(path.string(), "can't be written: " + std::generic_category().message(errno),
                      "choose another output or change the permissions");
  }
  stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) throw runtime_failure(path.string(), "can't be written", "free some space or choose another place");
  part.put_in_place();
}

}  // namespace rinkaku::silhouette
