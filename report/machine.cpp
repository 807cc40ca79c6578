#include "report/machine.h"

#include <array>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <sstream>
#include <thread>

#include <sys/utsname.h>

#include <opencv2/core/version.hpp>

#include "pipeline/ffmpeg/version.h"
#include "pipeline/frame/error.h"
#include "pipeline/gl/context.h"
#include "report/table.h"

namespace rinkaku::report {
namespace {

// The value of the first line of a /proc file that begins so.
std::string line_of(const char* file, const std::string& begin) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(begin)) continue;
    const std::size_t at = line.find_first_not_of(" \t", line.find(':') + 1);
    return at == std::string::npos ? std::string() : line.substr(at);
  }
  return {};
}

std::string memory() {
  const std::string kib = line_of("/proc/meminfo", "MemTotal");
  return kib.empty() ? "unknown" : readable(std::strtod(kib.c_str(), nullptr) / (1 << 20)) + " GiB";
}

std::string load() {
  std::array<double, 3> loads{};
  if (getloadavg(loads.data(), 3) < 1) return "unknown";
  return readable(loads[0]) + " processes were running or waiting in the minute before";
}

std::string renderer() {
  try {
    const auto context = gl::Context::headless();
    return context->version() + ", " + context->renderer();
  } catch (const Error&) {
    return "none";
  }
}

}  // namespace

std::vector<std::pair<std::string, std::string>> machine_facts() {
  const std::string processor = line_of("/proc/cpuinfo", "model name");
  utsname system{};
  uname(&system);
  const std::time_t now = std::time(nullptr);
  tm local{};
  gmtime_r(&now, &local);
  std::array<char, 64> date{};
  std::strftime(date.data(), date.size(), "%Y-%m-%d %H:%M UTC", &local);
  return {{"Date", date.data()},
          {"Processor", (processor.empty() ? "unknown" : processor) + ", " +
                            std::to_string(std::thread::hardware_concurrency()) + " cores"},
          {"Memory", memory()},
          {"Load", load()},
          {"System", std::string(system.sysname) + " " + system.release + " " + system.machine},
          {"OpenGL", renderer()},
          {"OpenCV", CV_VERSION},
          {"FFmpeg", ffmpeg::version()},
          {"Compiler", __VERSION__}};
}

}  // namespace rinkaku::report
