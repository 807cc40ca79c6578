#include <utility>
#include <vector>

#include "pipeline/gl/context.h"
#include "report/sections/sections.h"
#include "water/verify/painter.h"
#include "water/verify/scenes.h"
#include "water/verify/warping_error.h"

namespace rinkaku::report {
namespace {

using Colours = water::PaintingOptions::Colours;
using FlowMethod = water::FlowOptions::Method;

struct Way {
  const char* name;
  FlowMethod flow;
  Colours colours;
  bool mean;
};
constexpr Way ways[] = {{"point-sampled, arrows' field", FlowMethod::Arrows, Colours::Sampled, false},
                        {"point-sampled", FlowMethod::DivergenceFree, Colours::Sampled, false},
                        {"neighbourhood mean", FlowMethod::DivergenceFree, Colours::Sampled, true},
                        {"B-spline between keys", FlowMethod::DivergenceFree, Colours::Keys, true},
                        {"causal filter", FlowMethod::DivergenceFree, Colours::Followed, true}};

struct Measured {
  double error = 0, contrast = 0;
  Timing time;  // of a frame
};

// Far enough from the beginning that filters have forgotten it.
constexpr int first_frame = 60;

Measured measure(const water::River& river, const water::ReferencePicture& reference, const Way& way, int frames,
                 const Settings& settings) {
  water::PaintingOptions options;
  options.flow.method = way.flow;
  options.colours = way.colours;
  options.mean = way.mean;
  water::Painter painter(river, reference, options);
  water::Flow flow(*river.surface, river.arrows, options.flow);
  flow.set_frame(0);
  const water::WarpingError error(flow, *river.surface, river.camera, river.camera_from_world,
                                  options.seconds_per_frame);
  painter.draw(painter.strokes(first_frame - 1));
  Measured measured;
  Stopwatch watch;
  std::vector<glm::vec3> before, now;
  for (int i = 0; i <= frames; ++i) {
    check_interrupted(settings);
    const passes::Layer* layer = nullptr;
    watch.run([&] { layer = &painter.draw(painter.strokes(first_frame + i)); });
    water::over_grey(*layer, river.camera, now);
    if (i > 0) {
      measured.error += error.between(before, now) / frames;
      measured.contrast += error.contrast(now) / frames;
    }
    std::swap(before, now);
  }
  measured.time = watch.timing();
  return measured;
}

}  // namespace

Section flicker_section(const Settings& settings) {
  const auto context = gl::Context::headless();
  const int frames = settings.quick ? 6 : 60;
  Section section;
  section.repetitions = frames;
  section.intro =
      "Two painted waters of 7,000 strokes on 400x400 pixels, a river and a slowly turning pond, which mirror trees "
      "and "
      "clouds made of noise; " +
      std::to_string(frames) +
      " frames. Each frame is held against the next one carried back along the flow that moved the strokes (warping "
      "error: "
      "mean squared difference of components from 0 to 1). Carrying back is bilinear, which costs fine strokes some of "
      "the error. An empty picture would not flicker at all, so contrast is given as well.";
  section.table.columns = {{"water", "Water"},           {"method", "Method"},     {"error_e3", "Warping error, 1e-3"},
                           {"of_first", "of the first"}, {"contrast", "Contrast"}, {"time_ms", "Time a frame, ms"},
                           {"time_low_ms", "low"},       {"time_high_ms", "high"}, {"cpu_ms", "CPU, ms"}};
  for (const bool pond : {false, true}) {
    const water::River river = pond ? water::pond_scene() : water::river_scene();
    const water::ReferencePicture reference = water::reference_of(river);
    const char* name = pond ? "pond" : "river";
    Plot plot;
    plot.title = std::string("Flicker of a ") + name;
    plot.x.title = "time a frame, ms";
    plot.y.title = "warping error, 1e-3";
    double first = 0;
    for (const Way& way : ways) {
      const Measured m = measure(river, reference, way, frames, settings);
      if (&way == ways) first = m.error;
      section.table.rows.push_back({name, way.name, 1e3 * m.error, m.error / first, m.contrast, m.time.wall_ms.median,
                                    m.time.wall_ms.low, m.time.wall_ms.high, m.time.cpu_ms});
      plot.series.push_back({way.name, {timed_point(m.time.wall_ms, 1e3 * m.error, "")}, false});
    }
    plot.says = "Each point is one way to give strokes their colours. On the front: " + front_names(plot) +
                ". Keys lie ahead, so they need a camera that stands still; the causal filter follows any.";
    section.plots.push_back(std::move(plot));
  }
  return section;
}

}  // namespace rinkaku::report
