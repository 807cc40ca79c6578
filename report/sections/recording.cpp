#include "report/sections/recording.h"

#include "pipeline/frame/error.h"

namespace rinkaku::report {

std::filesystem::path recorded(const Settings& settings, const std::string& file) {
  constexpr const char* remedy = "give the folder 'recordings' of the project with --recordings";
  if (settings.recordings.empty()) throw input_error(file, "there is no folder of recordings", remedy);
  const std::filesystem::path path = settings.recordings / file;
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) throw input_error(path.string(), "isn't there", remedy);
  return path;
}

}  // namespace rinkaku::report
