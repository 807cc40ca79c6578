// The figures of docs/water.md: times, flow, paths, coverage and flicker. Run it on a quiet machine; all but the times
// come out the same everywhere.
//
//     build/release/bench/rinkaku-bench-water [times|flow|coverage|flicker]...
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "mesh/depth_order.h"
#include "pipeline/gl/context.h"
#include "water/painting.h"
#include "water/scatter.h"
#include "water/verify/painter.h"
#include "water/verify/scenes.h"
#include "water/verify/warping_error.h"

namespace rinkaku::bench {
namespace {

using namespace rinkaku::water;

double cpu_ms() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) / 1e6;
}
double wall_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

void times(const River& river, const ReferencePicture& reference) {
  for (const int count : {7000, 25000, 50000, 100000, 200000}) {
    PaintingOptions options;
    options.strokes = count;
    const double start = cpu_ms();
    Painter painter(river, reference, options);
    painter.strokes(0);
    const double made = cpu_ms() - start;
    std::vector<double> paint, draw, draw_cpu, whole;
    std::size_t drawn = 0;
    double prepared = 0;
    for (int frame = 1; frame <= 120; ++frame) {
      const double a = cpu_ms(), aw = wall_ms();
      const Strokes& strokes = painter.strokes(frame);
      const double b = cpu_ms(), bw = wall_ms();
      prepared += b - a;
      paint.push_back(b - a);
      if (frame % 4 == 0) {
        painter.draw(strokes);
        draw.push_back(wall_ms() - bw);
        draw_cpu.push_back(cpu_ms() - b);
        whole.push_back(wall_ms() - aw);
      }
      drawn = strokes.size();
    }
    std::printf(
        "%6d strokes (%6zu in the picture): set-up %.0f ms, painting %.2f ms a frame, drawing %.2f ms (CPU %.2f), one "
        "after "
        "the other %.2f ms; 120 frames prepared in %.0f ms\n",
        count, drawn, made, median(paint), median(draw), median(draw_cpu), median(whole), made + prepared);
  }
  std::vector<float> depths;
  for (std::uint64_t i = 0; i < 100000; ++i) depths.push_back(static_cast<float>(3 + 27 * scattered(i, 1)));
  mesh::DepthOrder order;
  std::vector<double> sort;
  for (int i = 0; i < 100; ++i) {
    const double a = cpu_ms();
    order.farthest_first(depths);
    sort.push_back(cpu_ms() - a);
  }
  std::printf("100,000 strokes sorted in %.2f ms\n", median(sort));
}

void flow(const River& river) {
  for (const auto method : {FlowOptions::Method::Arrows, FlowOptions::Method::DivergenceFree}) {
    FlowOptions options;
    options.method = method;
    Flow flow(*river.surface, river.arrows, options);
    flow.set_frame(0);
    const double h = flow.grid().cell_m / 8;
    double divergence = 0, gradient = 0, most_across = 0, speed = 0;
    int samples = 0;
    for (int y = 0; y < 200; ++y) {
      for (int x = 0; x < 200; ++x) {
        const glm::dvec2 p = river.surface->least() +
                             (river.surface->most() - river.surface->least()) * (glm::dvec2(x + 0.5, y + 0.5) / 200.0);
        if (!river.surface->contains(p)) continue;
        const glm::dvec2 dx = (flow.velocity(p + glm::dvec2(h, 0)) - flow.velocity(p - glm::dvec2(h, 0))) / (2 * h);
        const glm::dvec2 dy = (flow.velocity(p + glm::dvec2(0, h)) - flow.velocity(p - glm::dvec2(0, h))) / (2 * h);
        divergence += std::pow(dx.x + dy.y, 2);
        gradient += glm::dot(dx, dx) + glm::dot(dy, dy);
        speed += glm::length(flow.velocity(p)), ++samples;
      }
    }
    for (const BorderEdge& e : river.surface->edges()) {
      if (e.open) continue;
      const glm::dvec2 d = glm::normalize(e.b - e.a);
      for (int k = 0; k < 100; ++k) {
        const glm::dvec2 v = flow.velocity(e.a + (e.b - e.a) * ((k + 0.5) / 100));
        most_across = std::max(most_across, std::abs(v.x * d.y - v.y * d.x));
      }
    }
    const Deviation d = flow.deviation();
    std::printf(
        "%s: |div|/|grad| %.4f, most across a shore %.3f of the mean speed, from the arrows %.1f degrees (mean), "
        "%.1f (most), speed %.2f\n",
        method == FlowOptions::Method::Arrows ? "arrows" : "divergence-free", std::sqrt(divergence / gradient),
        most_across / (speed / samples), d.mean_rad * 180 / std::numbers::pi, d.largest_rad * 180 / std::numbers::pi,
        d.speed_ratio);
  }
}

void coverage(const River& river, const ReferencePicture& reference) {
  PaintingOptions options;
  Painter painter(river, reference, options);
  // Which pixels are water for certain: two pixels inside the border.
  std::vector<char> wet(400 * 400, 0);
  for (int y = 0; y < 400; ++y) {
    for (int x = 0; x < 400; ++x) {
      const SeenPoint p = back_projected(*river.surface, river.camera, river.camera_from_world, glm::dvec2(x, y));
      wet[y * 400 + x] = p.found && river.surface->contains(p.at);
    }
  }
  double worst = 0, mean = 0, most_births = 0, most_change = 0;
  std::size_t pixels = 0;
  std::vector<float> opacity(painter.particles().list().size(), -1);
  std::vector<std::uint32_t> serial(opacity.size(), 0);
  for (int frame = 0; frame < 1000; ++frame) {
    const passes::Layer& layer = painter.draw(painter.strokes(frame));
    std::size_t bare = 0;
    pixels = 0;
    for (int y = 0; y < layer.rect.height_px; ++y) {
      for (int x = 0; x < layer.rect.width_px; ++x) {
        if (!wet[(y + layer.rect.y_px) * 400 + x + layer.rect.x_px]) continue;
        ++pixels;
        // Bare: less than half covered.
        if (layer.rgba[(static_cast<std::size_t>(y) * layer.rect.width_px + x) * 4 + 3] < 128) ++bare;
      }
    }
    const double part = static_cast<double>(bare) / static_cast<double>(pixels);
    worst = std::max(worst, part), mean += part / 1000;
    const Particles& particles = painter.particles();
    const Census& census = particles.census();
    if (frame > 0) {
      most_births = std::max(
          most_births, (static_cast<double>(census.births) - census.flowed_in) / static_cast<double>(census.alive));
    }
    for (std::size_t i = 0; i < opacity.size(); ++i) {
      const Particle& p = particles.list()[i];
      const bool there = p.state != Particle::State::Free;
      const float now = there ? p.opacity : 0,
                  before = opacity[i] >= 0 && (!there || serial[i] == p.serial) ? opacity[i] : 0;
      if (frame > 0) most_change = std::max(most_change, static_cast<double>(std::abs(now - before)));
      opacity[i] = now, serial[i] = p.serial;
    }
    if (frame % 250 == 249) {
      std::printf("frame %d: bare %.3f %%, alive %zu, leaving %zu, births %zu, flowed in %.1f\n", frame, 100 * part,
                  census.alive, census.leaving, census.births, census.flowed_in);
    }
  }
  std::printf(
      "1,000 frames: bare water %.3f %% (mean), %.3f %% (worst frame); births beyond inflow at most %.2f %% a frame; "
      "opacity changes at most %.3f a frame\n",
      100 * mean, 100 * worst, 100 * most_births, most_change);
}

struct Flicker {
  double warping = 0, contrast = 0;
};
Flicker flicker(const River& river, const ReferencePicture& reference, const PaintingOptions& options, int frames) {
  Painter painter(river, reference, options);
  Flow flow(*river.surface, river.arrows, options.flow);
  flow.set_frame(0);
  const WarpingError error(flow, *river.surface, river.camera, river.camera_from_world, options.seconds_per_frame);
  std::vector<glm::vec3> before, now;
  Flicker f;
  for (int frame = 60; frame <= 60 + frames; ++frame) {
    over_grey(painter.draw(painter.strokes(frame)), river.camera, now);
    if (frame > 60) f.warping += error.between(before, now) / frames, f.contrast += error.contrast(now) / frames;
    std::swap(before, now);
  }
  return f;
}

void flicker(const River& river, const ReferencePicture& reference) {
  using Colours = PaintingOptions::Colours;
  struct Kind {
    const char* name;
    FlowOptions::Method method;
    Colours colours;
    bool mean;
    bool even = false;  ///< every stroke takes the same colour: what is left are the strokes themselves
  };
  ReferencePicture even;
  MirrorOptions nothing;
  nothing.reflection = 0;
  even.paint(*river.surface, river.camera, river.camera_from_world, nothing, nullptr, nullptr, 1, 2);
  double first = 0;
  for (const Kind& kind :
       {Kind{"user's field, point-sampled", FlowOptions::Method::Arrows, Colours::Sampled, false},
        Kind{"divergence-free, point-sampled", FlowOptions::Method::DivergenceFree, Colours::Sampled, false},
        Kind{"divergence-free, neighbourhood mean", FlowOptions::Method::DivergenceFree, Colours::Sampled, true},
        Kind{"divergence-free, mean, causal filter", FlowOptions::Method::DivergenceFree, Colours::Followed, true},
        Kind{"divergence-free, mean, B-spline keys", FlowOptions::Method::DivergenceFree, Colours::Keys, true},
        Kind{"the same, of one colour", FlowOptions::Method::DivergenceFree, Colours::Keys, true, true}}) {
    PaintingOptions options;
    options.flow.method = kind.method;
    options.colours = kind.colours;
    options.mean = kind.mean;
    const Flicker f = flicker(river, kind.even ? even : reference, options, 60);
    if (first == 0) first = f.warping;
    std::printf("%-38s warping error %.3f e-3 (%.3f of the first), contrast %.4f\n", kind.name, 1e3 * f.warping,
                f.warping / first, f.contrast);
  }
}

int run(int argc, char** argv) {
  const std::vector<std::string> asked(argv + 1, argv + argc);
  const auto wanted = [&](const char* what) {
    return asked.empty() || std::find(asked.begin(), asked.end(), what) != asked.end();
  };
  const auto context = gl::Context::headless();
  const River river = river_scene();
  const ReferencePicture reference = reference_of(river);
  if (wanted("times")) times(river, reference);
  if (wanted("flow")) flow(river);
  if (wanted("coverage")) coverage(river, reference);
  if (wanted("flicker")) {
    std::printf("A river:\n");
    flicker(river, reference);
    const River pond = pond_scene();
    std::printf("A pond in which water turns:\n");
    flicker(pond, reference_of(pond));
  }
  return 0;
}

}  // namespace
}  // namespace rinkaku::bench

int main(int argc, char** argv) { return rinkaku::bench::run(argc, argv); }
