// Makes the recordings and the mascot that lie in this folder. The same pictures come out every time.

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/frame/error.h"
#include "recordings/generator/check.h"
#include "recordings/generator/mascot.h"
#include "recordings/generator/recordings.h"

namespace {

constexpr const char* usage =
    "rinkaku-generate-recordings WHAT FOLDER [FIRST LAST]\n"
    "  WHAT    desk      the marker board on a desk, hand-held camera\n"
    "          tripod    the room that somebody walks through, locked camera\n"
    "          brook     a dry brook, locked camera\n"
    "          mascot    mascot.glb\n"
    "          preview   the mascot from three sides, as PNG\n"
    "          check     finds the board in the desk's video and compares with its poses\n"
    "  FOLDER  where the files go, e.g. recordings/desk; for check, where they are\n"
    "  FIRST LAST        only these frames (LAST excluded), to try things out\n";

void make_mascot_files(const std::filesystem::path& folder, bool preview) {
  using namespace rinkaku::recordings;
  const Mascot mascot = make_mascot();
  if (!is_closed_manifold(mascot.mesh)) {
    throw rinkaku::runtime_failure("mascot", "is not a closed manifold", "change the size of its cells");
  }
  std::filesystem::create_directories(folder);
  if (preview) {
    write_preview(folder / "front.png", mascot, 0, 12, 640);
    write_preview(folder / "side.png", mascot, 50, 20, 640);
    write_preview(folder / "back.png", mascot, 200, 20, 640);
  } else {
    write_glb(folder / "mascot.glb", mascot);
    std::printf("%zu triangles\n", mascot.mesh.triangles.size());
  }
}

}  // namespace

int main(int argc, char** argv) {
  using namespace rinkaku::recordings;
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() != 2 && arguments.size() != 4) {
    std::fputs(usage, stderr);
    return 2;
  }
  try {
    const std::string& what = arguments[0];
    const std::filesystem::path folder = arguments[1];
    FrameRange frames;
    if (arguments.size() == 4) frames = {std::stoi(arguments[2]), std::stoi(arguments[3])};
    if (what == "desk") {
      make_desk(folder, frames);
    } else if (what == "tripod") {
      make_tripod(folder, frames);
    } else if (what == "brook") {
      make_brook(folder, frames);
    } else if (what == "mascot" || what == "preview") {
      make_mascot_files(folder, what == "preview");
    } else if (what == "check") {
      std::fputs(check_desk(folder).c_str(), stdout);
    } else {
      std::fputs(usage, stderr);
      return 2;
    }
  } catch (const rinkaku::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.exit_status();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
