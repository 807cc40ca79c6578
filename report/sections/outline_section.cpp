#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

#include "pipeline/gl/context.h"
#include "pipeline/objects/lone_mesh.h"
#include "report/sections/sections.h"
#include "report/sections/shapes.h"

namespace rinkaku::report {
namespace {

constexpr int kSide_px = 480;
constexpr double kWidth_px = 4, kDistance_m = 4, kFocal_px = 700;

// Seen along the axis through its middle, a ball's contour is a circle of this radius.
const double kRadius_px = kFocal_px / std::sqrt(kDistance_m * kDistance_m - 1);

passes::View view_of(int frame) {
  passes::View view;
  view.camera.width_px = view.camera.height_px = kSide_px;
  view.camera.fx_px = view.camera.fy_px = kFocal_px;
  view.camera.cx_px = view.camera.cy_px = (kSide_px - 1) / 2.0;
  const glm::dmat4 turned = glm::rotate(glm::dmat4(1), 0.02 * frame, {0.2, 1, 0.3});
  view.camera_from_world = {glm::quat_cast(glm::dmat3(turned)), {0, 0, kDistance_m}};
  return view;
}

// How light the picture is over white paper, 0 to 1.
std::vector<float> lightness(const passes::Layer& layer) {
  std::vector<float> light(static_cast<std::size_t>(kSide_px) * kSide_px, 1);
  for (int y = 0; y < layer.rect.height_px; ++y) {
    for (int x = 0; x < layer.rect.width_px; ++x) {
      const std::uint8_t* s = layer.rgba.data() + (static_cast<std::size_t>(y) * layer.rect.width_px + x) * 4;
      light[static_cast<std::size_t>(y + layer.rect.y_px) * kSide_px + x + layer.rect.x_px] =
          static_cast<float>(s[0] + s[1] + s[2] + 3 * (255 - s[3])) / (3 * 255);
    }
  }
  return light;
}

double between(const std::vector<float>& picture, double x, double y) {
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const double fx = x - i, fy = y - j;
  const float* s = picture.data() + static_cast<std::size_t>(j) * kSide_px + i;
  return (s[0] * (1 - fx) + s[1] * fx) * (1 - fy) + (s[kSide_px] * (1 - fx) + s[kSide_px + 1] * fx) * fy;
}

// How wide the line is at each of many places around the contour: darkness summed up across it.
std::vector<double> widths(const std::vector<float>& with, const std::vector<float>& without) {
  constexpr int places = 720;
  constexpr double reach_px = 3 * kWidth_px, step_px = 0.1, ink = 0.07;
  std::vector<double> found;
  for (int i = 0; i < places; ++i) {
    const double angle = 2 * std::numbers::pi * i / places, cosine = std::cos(angle), sine = std::sin(angle);
    double sum = 0;
    for (double r = kRadius_px - reach_px; r < kRadius_px + reach_px; r += step_px) {
      const double x = (kSide_px - 1) / 2.0 + r * cosine, y = (kSide_px - 1) / 2.0 + r * sine;
      const double paper = between(without, x, y);
      sum += std::max(0.0, paper - between(with, x, y)) / (paper - ink) * step_px;
    }
    found.push_back(sum);
  }
  return found;
}

std::unique_ptr<passes::LayerRenderer> renderer_of(const mesh::Mesh& mesh,
                                                   const std::optional<pipeline::OutlineScene>& line) {
  passes::ToonOptions toon;
  toon.bands = 0;
  return pipeline::lone_mesh(mesh, glm::dmat4(1), toon, line, {0, 0, kSide_px, kSide_px});
}

struct Style {
  std::string name;
  std::unique_ptr<passes::LayerRenderer> renderer;
  Stopwatch watch{};
  double squares = 0, sum = 0, change = 0;
  int places = 0, gaps = 0, changes = 0;
  std::vector<double> last{};

  void add(const std::vector<double>& found) {
    for (std::size_t i = 0; i < found.size(); ++i) {
      squares += (found[i] - kWidth_px) * (found[i] - kWidth_px), sum += found[i], ++places;
      gaps += found[i] < kWidth_px / 4 ? 1 : 0;
      if (!last.empty()) change += std::abs(found[i] - last[i]), ++changes;
    }
    last = found;
  }
  double width_error_px() const { return std::sqrt(squares / places); }
  double gap_part() const { return static_cast<double>(gaps) / places; }
  double flicker_px() const { return changes > 0 ? change / changes : 0; }
};

std::vector<Style> styles_of(const mesh::Mesh& ball) {
  std::vector<Style> styles;
  for (const pipeline::NamedMethod& named : pipeline::line_methods()) {
    pipeline::OutlineScene line;
    line.method = named.method;
    line.width_px = kWidth_px;
    line.taper_px = pipeline::usual_taper_px(named.method);
    if (pipeline::brings_inner_lines(named.method)) line.style.inner.emplace();
    styles.push_back({named.word, renderer_of(ball, line)});
  }
  return styles;
}

Plot plot_of(const std::vector<Style>& styles, const char* title, const char* y, double (Style::*value)() const) {
  Plot plot;
  plot.title = title;
  plot.x.title = "time a frame, body and line, ms";
  plot.y.title = y;
  for (const Style& style : styles) {
    plot.series.push_back(
        {style.name, {timed_point(style.watch.timing().wall_ms, (style.*value)(), style.name)}, false});
  }
  plot.says = "On the front: " + front_names(plot) + ".";
  return plot;
}

}  // namespace

Section outline_section(const Settings& settings) {
  const auto context = gl::Context::headless();
  Ellipsoid shape;
  shape.axes = {1, 1, 1};
  const mesh::Mesh ball = shape.mesh(settings.quick ? 32 : 64);
  const auto bare = renderer_of(ball, std::nullopt);
  std::vector<Style> styles = styles_of(ball);
  const int frames = settings.quick ? 6 : 40;
  passes::Layer layer;
  for (int frame = -1; frame < frames; ++frame) {
    const passes::View view = view_of(frame);
    bare->draw(view, layer);
    const std::vector<float> without = lightness(layer);
    for (Style& style : styles) {
      check_interrupted(settings);
      if (frame < 0) {
        style.renderer->draw(view, layer);  // warms up
        continue;
      }
      style.watch.run([&] { style.renderer->draw(view, layer); });
      style.add(widths(lightness(layer), without));
    }
  }
  Section section;
  section.repetitions = frames;
  section.intro =
      "A turning ball of " + std::to_string(ball.triangles.size()) +
      " triangles with a line of 4 px in every style, at 480x480. Its contour is a circle that stands still, "
      "so the line's width is measured across it at 720 places. A gap is where less than a quarter of the "
      "width is left. Styles that vary their width by design err here by as much.";
  section.table.columns = {{"style", "Style"},
                           {"width_px", "Width, px, mean"},
                           {"width_error_px", "Width error, px, RMS"},
                           {"gaps", "Part in gaps"},
                           {"flicker_px", "Change a frame, px"},
                           {"time_ms", "Time a frame, ms"},
                           {"time_low_ms", "low"},
                           {"time_high_ms", "high"},
                           {"cpu_ms", "CPU, ms"}};
  for (const Style& style : styles) {
    const Timing time = style.watch.timing();
    section.table.rows.push_back({style.name, style.sum / style.places, style.width_error_px(), style.gap_part(),
                                  style.flicker_px(), time.wall_ms.median, time.wall_ms.low, time.wall_ms.high,
                                  time.cpu_ms});
  }
  section.plots.push_back(
      plot_of(styles, "How even the line is", "width error, px (root mean square)", &Style::width_error_px));
  section.plots.push_back(
      plot_of(styles, "How much of the line is missing", "part of the contour in gaps", &Style::gap_part));
  section.plots.push_back(
      plot_of(styles, "How much it flickers as the ball turns", "change of the width a frame, px", &Style::flicker_px));
  section.plots[0].says +=
      " The styles curvature, facing and isophote vary the width by design, wobble and strokes by hand.";
  const bool whole = std::all_of(styles.begin(), styles.end(), [](const Style& style) { return style.gaps == 0; });
  if (whole) section.plots[1].says += " No style leaves any of the contour out.";
  section.plots[2].says += " Lines found in pictures change with the pixels, those that are drawn as geometry hardly.";
  return section;
}

}  // namespace rinkaku::report
