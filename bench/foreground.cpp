// What finding filmed people costs: CPU time a frame on one core for each way, the refinement, and the thing's own
// colours, on a recording; and how fast its whole scene is rendered with each. See docs/mattes.md.
//
//   rinkaku-bench-foreground [FOLDER]
//
// FOLDER holds video.mp4, clean.jpg and scene.toml; by default recordings/tripod.

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <opencv2/core/utility.hpp>

#include "pipeline/frame/error.h"
#include "pipeline/matte/difference.h"
#include "pipeline/matte/own_colour.h"
#include "pipeline/matte/person_network.h"
#include "pipeline/matte/refinement.h"
#include "pipeline/matte/segmentation.h"
#include "pipeline/pipeline.h"
#include "pipeline/source/source.h"

namespace {

using namespace rinkaku;

double cpu_ms(const std::function<void()>& work) {
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
  };
  const double start = now();
  work();
  return now() - start;
}

void print(const char* name, std::vector<double> ms) {
  std::sort(ms.begin(), ms.end());
  std::printf("  %-14s %6.2f ms in the median, %6.2f in the 95th percentile, first or worst %7.2f\n", name,
              ms[ms.size() / 2], ms[ms.size() * 95 / 100], ms.back());
  std::fflush(stdout);
}

void measure(matte::MatteEstimator& estimator, const std::vector<Frame>& frames) {
  std::vector<double> found, refined, coloured;
  matte::PictureReader reader;
  matte::Refinement refinement;
  matte::OwnColours own_colours;
  Matte matte;
  double covered = 0;
  for (const Frame& frame : frames) {
    found.push_back(cpu_ms([&] { estimator.estimate(frame, matte); }));
    covered += static_cast<double>(matte.rect.width_px) * matte.rect.height_px / static_cast<double>(frames.size());
    const matte::Picture& picture = reader.read(frame);
    refined.push_back(cpu_ms([&] { refinement.refine(picture, matte); }));
    coloured.push_back(cpu_ms([&] { own_colours.find(picture, matte); }));
  }
  std::printf("%s: the matte's rectangle has %.0f pixels on the average\n", estimator.name(), covered);
  print("matte", found);
  print("refinement", refined);
  print("own colours", coloured);
}

// The scene's things by this method, all threads, to H.264; the file is thrown away.
void render_whole(const std::string& folder, const char* name, const pipeline::ForegroundScene::Method& method,
                  bool refine) {
  const auto file = std::filesystem::temp_directory_path() / "rinkaku-bench-foreground.mp4";
  pipeline::Scene scene = pipeline::read_scene(folder + "/scene.toml");
  for (pipeline::ForegroundScene& each : scene.foregrounds) {
    each.methods = {method};
    each.options.refine = refine;
  }
  pipeline::RenderOptions options;
  options.output = file.string();
  options.overwrite = true;
  const std::atomic<bool> never{false};
  pipeline::RenderReport report;
  const double cpu =
      cpu_ms([&] { report = pipeline::render(pipeline::prepare(std::move(scene), options), options, never); });
  const auto frames = static_cast<double>(report.frames);
  std::printf("whole pipeline with %s: %.1f frames/s, %.1f ms of CPU a frame\n", name, frames / report.seconds,
              cpu / frames);
  std::filesystem::remove(file);
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  const std::string folder = argc > 1 ? argv[1] : RINKAKU_SOURCE_DIR "/recordings/tripod";
  try {
    const auto video = source::open(folder + "/video.mp4");
    std::vector<Frame> frames;
    while (auto frame = video->next()) frames.push_back(std::move(*frame));
    if (frames.empty()) throw input_error(folder, "holds no frames");
    const PictureFormat& format = frames.front().format;
    std::printf("%zu frames of %dx%d; CPU time, one thread\n", frames.size(), format.width_px, format.height_px);
    matte::DifferenceMatte difference(source::open(folder + "/clean.jpg")->next());
    measure(difference, frames);
    matte::PersonNetwork network(matte::installed_model());
    matte::SegmentationMatte segmentation([&](const matte::Picture& picture, const PixelRect& part, cv::Mat& likely) {
      network.find(picture, part, likely);
    });
    measure(segmentation, frames);
    frames.clear();
    render_whole(folder, "difference", pipeline::DifferenceMatteScene{folder + "/clean.jpg", {}}, false);
    render_whole(folder, "segmentation", pipeline::SegmentationScene{}, true);
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.exit_status();
  }
  return 0;
}
