#pragma once

#include <atomic>

namespace rinkaku::gl {

/// The counters behind made(); for the files of this folder.
struct Counters {
  std::atomic<int> contexts{0}, programs{0}, buffers{0}, textures{0}, targets{0};
};
Counters& counters();

}  // namespace rinkaku::gl
