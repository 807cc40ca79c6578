#include "pipeline/source/source.h"
#include "pipeline/source/video_source.h"

namespace rinkaku::source {

std::unique_ptr<Source> open(const std::string& path, const OpenOptions& options) {
  return std::make_unique<VideoSource>(find_input(path), options);
}

}  // namespace rinkaku::source
