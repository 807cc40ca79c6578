// Scenes that need neither water, filmed things nor fluff, rendered by a program that has all of these and by one that
// is built without them, in turn: what the first costs more is what being able to do it costs. See docs/benchmarks.md.

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <unistd.h>

#include "report/child.h"
#include "report/samples.h"

namespace {

namespace fs = std::filesystem;
using rinkaku::report::ChildRun;
using rinkaku::report::spread;

struct Program {
  const char* name;
  std::string path;
  std::vector<double> start_ms{}, frame_ms{};
  double peak_mib = 0;
  std::string made{};
};

struct SceneCase {
  const char* name;
  std::string file;
};

ChildRun run(const std::vector<std::string>& command, const fs::path& prints) {
  const ChildRun run = rinkaku::report::run_child(command, prints);
  if (run.status == 0) return run;
  std::fprintf(stderr, "failed: %s %s\n", command[0].c_str(), command[1].c_str());
  std::exit(1);
}

void compare(const SceneCase& scene, const fs::path& folder, int rounds, int frames) {
  std::vector<Program> programs = {{"with all", RINKAKU_WHOLE}, {"without", RINKAKU_LEAN}};
  const std::string out = (folder / "out.mp4").string();
  for (int round = 0; round <= rounds; ++round) {
    for (Program& program : programs) {
      const ChildRun first = run({program.path, scene.file, out, "1"}, folder / "made");
      const ChildRun all = run({program.path, scene.file, out, std::to_string(frames)}, folder / "made");
      if (round == 0) continue;  // warms the caches
      program.start_ms.push_back(first.cpu_ms);
      program.frame_ms.push_back((all.cpu_ms - first.cpu_ms) / (frames - 1));
      program.peak_mib = std::max(program.peak_mib, all.peak_mib);
      std::getline(std::ifstream(folder / "made") >> std::ws, program.made);
    }
  }
  std::vector<double> ratios;
  for (std::size_t i = 0; i < programs[0].frame_ms.size(); ++i) {
    ratios.push_back(programs[0].frame_ms[i] / programs[1].frame_ms[i]);
  }
  std::printf("%s\n", scene.name);
  for (const Program& program : programs) {
    const auto start = spread(program.start_ms), frame = spread(program.frame_ms);
    std::printf(
        "  %-9s start %6.1f (%.1f to %.1f) CPU ms, a frame %6.2f (%.2f to %.2f) CPU ms, %6.1f MiB, "
        "shader programs, buffers, textures: %s\n",
        program.name, start.median, start.low, start.high, frame.median, frame.low, frame.high, program.peak_mib,
        program.made.c_str());
  }
  const auto ratio = spread(ratios);
  std::printf("  a frame, with all / without %.3f (%.3f to %.3f)\n", ratio.median, ratio.low, ratio.high);
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 7, frames = argc > 2 ? std::atoi(argv[2]) : 150;
  if (rounds < 1 || frames < 2) {
    std::fprintf(stderr, "usage: %s [ROUNDS [FRAMES]]\n", argv[0]);
    return 2;
  }
  const fs::path folder = fs::temp_directory_path() / ("rinkaku_bench_" + std::to_string(getpid()));
  fs::create_directories(folder);
  const std::string desk = RINKAKU_SOURCE_DIR "/recordings/desk";
  std::ofstream(folder / "empty.toml") << "[plate]\nvideo = \"" << desk << "/video.mp4\"\n";
  compare({"an empty scene", (folder / "empty.toml").string()}, folder, rounds, frames);
  compare({"recordings/desk: an object with an outline, tracked, through a lens", desk + "/scene.toml"}, folder, rounds,
          frames);
  fs::remove_all(folder);
}
