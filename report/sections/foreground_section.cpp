#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <optional>
#include <utility>

#include "pipeline/frame/error.h"
#include "pipeline/matte/chroma.h"
#include "pipeline/matte/difference.h"
#include "pipeline/matte/person_network.h"
#include "pipeline/matte/picture.h"
#include "pipeline/matte/refinement.h"
#include "pipeline/matte/score.h"
#include "pipeline/matte/segmentation.h"
#include "pipeline/source/source.h"
#include "report/sections/before_screen.h"
#include "report/sections/recording.h"
#include "report/sections/sections.h"

namespace rinkaku::report {
namespace {

// What the others are measured by: brightness that differs from the clean plate's by more than a fixed step.
class PlainThreshold : public matte::MatteEstimator {
 public:
  explicit PlainThreshold(const Frame& clean) {
    matte::PictureReader reader;
    clean_ = reader.read(clean).luma.clone();
    black_ = reader.read(clean).black;
  }
  const char* name() const override { return "plain threshold"; }
  void estimate(const Frame& frame, Matte& matte) override {
    matte::begin_matte(frame, matte);
    const matte::Picture& picture = reader_.read(frame);
    // A still picture is of full range, a video mostly not.
    const double scale = picture.black > black_ ? 219.0 / 255 : 1;
    constexpr double step = 24;
    for (int y = 0; y < picture.luma.rows; ++y) {
      const std::uint8_t* now = picture.luma.ptr(y);
      const std::uint8_t* before = clean_.ptr(y);
      for (int x = 0; x < picture.luma.cols; ++x) {
        const double off = now[x] - picture.black - (before[x] - black_) * scale;
        matte.alpha_row(y)[x] = std::abs(off) > step ? 255 : 0;
      }
    }
  }

 private:
  cv::Mat clean_;
  float black_ = 0;
  matte::PictureReader reader_;
};

struct Way {
  std::string name;
  std::unique_ptr<matte::MatteEstimator> estimator;
  bool before_screen = false;  // looks at the thing before a screen, not in the room
  bool refined = false;
  Matte matte{};
  matte::PictureReader reader{};
  matte::Refinement refinement{};
  Stopwatch watch{};
  std::vector<double> sad{}, f1{}, f3{}, iou{}, flicker{};
  std::vector<float> last_error{};

  void run(const Frame& frame) {
    estimator->estimate(frame, matte);
    if (refined) refinement.refine(reader.read(frame), matte);
  }
};

// Empty if the model isn't installed.
std::unique_ptr<matte::MatteEstimator> segmentation() {
  try {
    auto network = std::make_shared<matte::PersonNetwork>(matte::installed_model());
    return std::make_unique<matte::SegmentationMatte>(
        [network](const matte::Picture& picture, const PixelRect& part, cv::Mat& likely) {
          network->find(picture, part, likely);
        });
  } catch (const Error&) {
    return nullptr;
  }
}

std::vector<Way> ways_of(const Frame& clean) {
  std::vector<Way> ways;
  const auto add = [&ways](std::string name, std::unique_ptr<matte::MatteEstimator> estimator) -> Way& {
    Way& way = ways.emplace_back();
    way.name = std::move(name);
    way.estimator = std::move(estimator);
    return way;
  };
  add("difference, clean plate", std::make_unique<matte::DifferenceMatte>(clean));
  add("the same, refined", std::make_unique<matte::DifferenceMatte>(clean)).refined = true;
  add("difference, learnt", std::make_unique<matte::DifferenceMatte>(std::nullopt));
  if (auto network = segmentation()) add("segmentation, refined", std::move(network)).refined = true;
  if (auto network = segmentation()) add("segmentation, bare", std::move(network));
  add("chroma, before a screen", std::make_unique<matte::ChromaMatte>()).before_screen = true;
  add("plain threshold", std::make_unique<PlainThreshold>(clean));
  return ways;
}

matte::GreyMatte grey(int width_px, int height_px, const std::uint8_t* samples, std::ptrdiff_t stride) {
  matte::GreyMatte out{width_px, height_px, {}};
  out.alpha.reserve(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) out.alpha.push_back(static_cast<float>(samples[y * stride + x]) / 255);
  }
  return out;
}

Matte matte_of(const Frame& frame, const matte::GreyMatte& truth) {
  Matte out;
  matte::begin_matte(frame, out);
  for (std::size_t i = 0; i < truth.alpha.size(); ++i) {
    out.alpha[i] = static_cast<std::uint8_t>(truth.alpha[i] * 255 + 0.5f);
  }
  return out;
}

void compare(Way& way, const matte::GreyMatte& truth, bool scored) {
  const matte::GreyMatte found =
      grey(way.matte.width_px, way.matte.height_px, way.matte.alpha.data(), way.matte.width_px);
  double change = 0;
  std::vector<float> error(found.alpha.size());
  for (std::size_t i = 0; i < error.size(); ++i) {
    error[i] = found.alpha[i] - truth.alpha[i];
    if (!way.last_error.empty()) change += std::abs(error[i] - way.last_error[i]);
  }
  if (!way.last_error.empty()) way.flicker.push_back(change);
  way.last_error = std::move(error);
  if (!scored) return;
  const matte::Score s = matte::score(found, truth);
  way.sad.push_back(s.sad), way.f1.push_back(s.boundary_f1), way.f3.push_back(s.boundary_f3), way.iou.push_back(s.iou);
}

Plot plot_of(const std::vector<Way>& ways, const char* title, const char* y, double (*value)(const Way&)) {
  Plot plot;
  plot.title = title;
  plot.x.title = "time a frame, ms";
  plot.y.title = y;
  for (const Way& way : ways) {
    plot.series.push_back({way.name, {timed_point(way.watch.timing().wall_ms, value(way), way.name)}, false});
  }
  return plot;
}

}  // namespace

Section foreground_section(const Settings& settings) {
  const auto video = source::open(recorded(settings, "tripod/video.mp4").string());
  const auto truths = source::open(recorded(settings, "tripod/matte.mkv").string());
  const std::string clean_file = recorded(settings, "tripod/clean.jpg").string();
  const std::optional<Frame> clean = source::open(clean_file)->next();
  if (!clean) throw input_error(clean_file, "it holds no picture");
  std::vector<Way> ways = ways_of(*clean);
  const int frames = settings.quick ? 40 : 135, every = settings.quick ? 10 : 4;
  int seen = 0;
  for (; seen < frames; ++seen) {
    check_interrupted(settings);
    const auto frame = video->next(), true_frame = truths->next();
    if (!frame || !true_frame) break;
    const Frame& t = *true_frame;
    const matte::GreyMatte truth =
        grey(t.format.width_px, t.format.height_px, t.planes[0].data, t.planes[0].stride_bytes);
    constexpr int empty_frames = 10;  // that show the room alone
    const bool scored = seen >= empty_frames && seen % every == 0;
    const Frame screened = before_screen(*frame, *clean, matte_of(*frame, truth));
    for (Way& way : ways) {
      way.watch.run([&] { way.run(way.before_screen ? screened : *frame); });
      if (seen >= empty_frames - 1) compare(way, truth, scored);
    }
  }
  Section section;
  section.intro =
      "recordings/tripod, " + std::to_string(seen) +
      " frames of 1280x720 in which somebody walks through a room, whose true matte is known. SAD is the sum of "
      "differences of alpha; boundary F counts boundaries matched within 1 pixel; flicker is how much the "
      "error changes from frame to frame, summed over the picture.";
  section.table.columns = {
      {"method", "Method"},     {"sad", "SAD"},         {"boundary_f1", "Boundary F, 1 px"}, {"boundary_f3", "3 px"},
      {"iou", "IoU"},           {"flicker", "Flicker"}, {"time_ms", "Time a frame, ms"},     {"time_low_ms", "low"},
      {"time_high_ms", "high"}, {"cpu_ms", "CPU, ms"}};
  section.repetitions = seen;
  for (const Way& way : ways) {
    const Timing time = way.watch.timing();
    section.table.rows.push_back({way.name, spread(way.sad).median, spread(way.f1).median, spread(way.f3).median,
                                  spread(way.iou).median, spread(way.flicker).median, time.wall_ms.median,
                                  time.wall_ms.low, time.wall_ms.high, time.cpu_ms});
  }
  section.plots.push_back(plot_of(ways, "How much of the matte is wrong", "SAD, pixels",
                                  [](const Way& w) { return spread(w.sad).median; }));
  section.plots.push_back(plot_of(ways, "How far the boundary is missed", "1 - boundary F within 1 px",
                                  [](const Way& w) { return 1 - spread(w.f1).median; }));
  section.plots.push_back(plot_of(ways, "How much it flickers", "change of the error a frame, pixels",
                                  [](const Way& w) { return spread(w.flicker).median; }));
  for (Plot& plot : section.plots) plot.says = "On the front: " + front_names(plot) + ". ";
  section.plots[0].says += "A fixed threshold is fast and takes shadows for the walker; ";
  section.plots[0].says += "without a clean plate the room has to be learnt first.";
  section.plots[1].says += "Medians over the frames that were scored.";
  section.plots[2].says += "What is wrong in the same way in every frame doesn't flicker.";
  section.notes.emplace_back(
      "For chroma keying the walker is put before a green screen by the true matte: another, easier picture. "
      "Segmentation finds a person, not the rucksack, which is a tenth of this one. Mattes read from files are as good "
      "as the files.");
  if (std::none_of(ways.begin(), ways.end(), [](const Way& w) { return w.name.starts_with("segmentation"); })) {
    section.notes.emplace_back("Segmentation is not among them, as its model isn't installed: scripts/fetch-model.");
  }
  return section;
}

}  // namespace rinkaku::report
