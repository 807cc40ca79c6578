// What finding filmed people costs: CPU time a frame on one core for each way, the refinement, and the thing's own
// colours, on a recording. See docs/mattes.md.
//
//   rinkaku-bench-foreground [FOLDER]
//
// FOLDER holds video.mp4 and clean.jpg; by default recordings/tripod. For the whole pipeline's rate, render a scene:
// `rinkaku render` prints it.

#include <algorithm>
#include <cstdio>
#include <ctime>
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
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.exit_status();
  }
  return 0;
}
