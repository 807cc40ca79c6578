// The speed of every way of drawing lines, as part of the uniform hull's (Raskar and Cohen), for a bumpy ring of
// as many vertices as the rows of tables 3.2, 3.3, 4.2 and 4.3 of Matsuo's thesis have, at 1024x768. The ways take
// turns frame by frame, so that what else the machine does falls on all of them alike; medians count.
//
//   rinkaku-bench-outlines [FRAMES [MOST_VERTICES]]

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "mesh/contour.h"
#include "mesh/topology.h"
#include "outline/control_points.h"
#include "outline/line_width.h"
#include "pipeline/frame/error.h"
#include "pipeline/gl/context.h"
#include "pipeline/objects/control_line.h"
#include "pipeline/objects/lone_mesh.h"
#include "report/sections/shapes.h"

namespace {

using namespace rinkaku;

mesh::Mesh ring(std::size_t vertices) {
  const auto across = static_cast<int>(std::max(8.0, std::round(std::sqrt(vertices / 2.2))));
  const auto around = (static_cast<int>(vertices) + across / 2) / across;
  return report::closed_grid(around, across, [](double u, double v) {
    const double thick = 0.4 + 0.05 * std::sin(5 * u) * std::cos(3 * v), radius = 1 + thick * std::cos(v);
    return glm::dvec3(radius * std::cos(u), radius * std::sin(u), thick * std::sin(v));
  });
}

struct Way {
  std::string name;
  std::unique_ptr<passes::LayerRenderer> renderer;
  std::function<void(std::span<const std::uint32_t> contour)>
      before_each_frame;  ///< points that the contour runs through
  std::vector<double> ms{};
};

constexpr int kWidth_px = 1024, kHeight_px = 768;

passes::View view_of(int frame) {
  passes::View view;
  view.camera.width_px = kWidth_px, view.camera.height_px = kHeight_px;
  view.camera.fx_px = view.camera.fy_px = 1000;
  view.camera.cx_px = (kWidth_px - 1) / 2.0, view.camera.cy_px = (kHeight_px - 1) / 2.0;
  const glm::dmat4 turned = glm::rotate(glm::rotate(glm::dmat4(1), 0.9, {1, 0, 0}), 0.01 * frame, {0.2, 0.3, 1});
  view.camera_from_world = {glm::quat_cast(glm::dmat3(turned)), {0, 0, 4.4}};
  return view;
}

std::unique_ptr<passes::LayerRenderer> renderer_of(const mesh::Mesh& mesh,
                                                   const std::optional<pipeline::OutlineScene>& line) {
  return pipeline::lone_mesh(mesh, glm::dmat4(1), {}, line, {0, 0, kWidth_px, kHeight_px});
}

// As objects that move do it: along the contour, and as far around it as smoothing reaches.
template <class Widths>
auto anew_each_frame(std::shared_ptr<mesh::Topology> topology, std::shared_ptr<Widths> widths) {
  return [topology, widths, factors = std::vector<float>(topology->points.size())](
             std::span<const std::uint32_t> contour) mutable { widths->at(topology->points, contour, factors); };
}

std::vector<Way> ways_for(const mesh::Mesh& mesh) {
  std::vector<Way> ways;
  for (const pipeline::NamedMethod& named : pipeline::line_methods()) {
    pipeline::OutlineScene line;
    line.method = named.method;
    line.taper_px = pipeline::usual_taper_px(named.method);
    if (pipeline::brings_inner_lines(named.method)) line.style.inner.emplace();
    ways.push_back({named.word, renderer_of(mesh, line), [](auto) {}});
    if (named.method == pipeline::LineMethod::Control) {
      // The thesis's chapter 3 with a shape that changes every frame: features and their widths anew.
      auto topology = std::make_shared<mesh::Topology>(mesh::topology(mesh));
      auto widths = std::make_shared<outline::ControlWidths>(pipeline::control_widths(line, *topology, glm::dmat4(1)));
      ways.push_back({"control each frame", renderer_of(mesh, line), anew_each_frame(topology, widths)});
    }
    if (named.method != pipeline::LineMethod::Curvature) continue;
    // What a shape that changes every frame costs more: its curvature, and the widths that follow it.
    auto topology = std::make_shared<mesh::Topology>(mesh::topology(mesh));
    auto widths = std::make_shared<outline::CurvatureWidths>(*topology, outline::WidthOptions{});
    ways.push_back({"curvature each frame", renderer_of(mesh, line), anew_each_frame(topology, widths)});
    // The same everywhere, and not only along the contour.
    ways.push_back(
        {"curvature of all", renderer_of(mesh, line), [topology, widths](auto) { widths->at(topology->points); }});
  }
  ways.push_back({"none", renderer_of(mesh, std::nullopt), [](auto) {}});
  return ways;
}

// Of all threads: what else the machine does is not in it.
double cpu_ms() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

void measure(std::size_t vertices, int frames, bool header) {
  const mesh::Mesh mesh = ring(vertices);
  std::vector<Way> ways = ways_for(mesh);
  const mesh::Topology topology = mesh::topology(mesh);
  mesh::ContourFinder finder(mesh, topology);
  std::vector<std::uint32_t> contour;
  passes::Layer layer;
  constexpr int warm = 3;
  for (int frame = 0; frame < frames + warm; ++frame) {
    const passes::View view = view_of(frame);
    contour.clear();
    for (const std::uint32_t e : finder.find(inverse(view.camera_from_world).translation_m).edges) {
      contour.insert(contour.end(), {topology.edges[e].a, topology.edges[e].b});
    }
    for (Way& way : ways) {
      const double start_ms = cpu_ms();
      way.before_each_frame(contour);
      way.renderer->draw(view, layer);
      if (frame >= warm) way.ms.push_back(cpu_ms() - start_ms);
    }
  }
  const auto hull = std::find_if(ways.begin(), ways.end(), [](const Way& way) { return way.name == "hull"; });
  const double hull_ms = median(hull->ms);
  if (header) {
    std::printf("| vertices | hull, ms |");
    for (const Way& way : ways) {
      if (way.name != "hull") std::printf(" %s |", way.name.c_str());
    }
    std::printf("\n| --- | --- |");
    for (std::size_t i = 1; i < ways.size(); ++i) std::printf(" --- |");
    std::printf("\n");
  }
  std::printf("| %u | %.2f |", mesh.point_count, hull_ms);
  for (const Way& way : ways) {
    if (way.name != "hull") std::printf(" %.2f |", hull_ms / median(way.ms));
  }
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int frames = argc > 1 ? std::max(std::atoi(argv[1]), 1) : 60;
  const std::size_t most = argc > 2 ? static_cast<std::size_t>(std::max(std::atoi(argv[2]), 0)) : 100000;
  try {
    const auto context = gl::Context::headless();
    std::printf(
        "%s, %dx%d, medians of %d frames, processor time of all threads; speeds as parts of the uniform hull's\n\n",
        context->renderer().c_str(), kWidth_px, kHeight_px, frames);
    bool header = true;
    for (const std::size_t vertices : {503, 1170, 2082, 3242, 485, 4250, 15859, 28741, 63576}) {
      if (vertices > most) continue;
      measure(vertices, frames, header);
      header = false;
    }
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.exit_status();
  }
  return 0;
}
