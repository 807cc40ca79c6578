#include "apps/rinkaku/viewer/screenshot.h"

#include <cstdio>
#include <filesystem>

#include "pipeline/sink/sink.h"

namespace rinkaku::app {

std::string save_screenshot(const Frame& frame, const std::string& folder) {
  std::filesystem::path path;
  for (int number = 1; path.empty() || std::filesystem::exists(path); ++number) {
    char name[32];
    std::snprintf(name, sizeof name, "rinkaku_%06d.png", number);
    path = std::filesystem::path(folder) / name;
  }
  sink::Options options;
  options.path = path.string();
  sink::Incoming incoming;
  incoming.format = frame.format;
  incoming.time_base = frame.time_base;
  incoming.frame_rate = {25, 1};
  const auto picture = sink::open(options, incoming);
  Frame only = frame;
  only.number = 0;
  picture->write(only);
  picture->finish();
  return path.string();
}

}  // namespace rinkaku::app
