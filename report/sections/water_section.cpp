#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <utility>

#include <glm/geometric.hpp>

#include "report/sections/sections.h"
#include "water/flow.h"

namespace rinkaku::report {
namespace {

// One step of an integrator through a field that stands still.
using Velocity = std::function<glm::dvec2(const glm::dvec2&)>;
using Step = glm::dvec2 (*)(const Velocity&, const glm::dvec2&, double);

glm::dvec2 euler(const Velocity& v, const glm::dvec2& p, double h) { return p + h * v(p); }
glm::dvec2 midpoint(const Velocity& v, const glm::dvec2& p, double h) { return p + h * v(p + h / 2 * v(p)); }
glm::dvec2 runge_kutta(const Velocity& v, const glm::dvec2& p, double h) {
  const glm::dvec2 a = v(p), b = v(p + h / 2 * a), c = v(p + h / 2 * b), d = v(p + h * c);
  return p + h / 6 * (a + 2.0 * b + 2.0 * c + d);
}

constexpr double kSeconds = 4;

void carry(const Velocity& v, Step step, int steps, std::vector<glm::dvec2>& points) {
  for (glm::dvec2& p : points) {
    for (int i = 0; i < steps; ++i) p = step(v, p, kSeconds / steps);
  }
}

// A round pool that is stirred about its middle, quicker the nearer to it.
struct Pool {
  water::Surface surface{"pool", outline(), {0, 0, 5}};
  water::Flow flow{surface, keys(), water::FlowOptions{}};

  Pool() { flow.set_frame(0); }
  static constexpr double radius_m = 4;
  static water::SurfaceOutline outline() {
    water::SurfaceOutline out;
    constexpr int corners = 48;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * i / corners;
      out.corners.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle), 0);
    }
    return out;
  }
  std::vector<water::ArrowKey> keys() const {
    water::ArrowKey key;
    for (const double r : {0.8, 1.8, 3.0}) {
      for (int i = 0; i < 12; ++i) {
        const double angle = 2 * std::numbers::pi * i / 12;
        const glm::dvec3 out(std::cos(angle), std::sin(angle), 0), along(-out.y, out.x, 0);
        key.arrows.push_back({surface.from_world(r * out), surface.direction_from_world(along * (2.5 / (0.5 + r)))});
      }
    }
    return {key};
  }
  std::vector<glm::dvec2> start(int count, std::uint64_t seed) const {
    std::mt19937_64 engine(seed);
    const auto unit = [&engine] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
    std::vector<glm::dvec2> points;
    for (int i = 0; i < count; ++i) {
      // Away from the shore, where the product slides along and others would run aground.
      const double r = 0.75 * radius_m * std::sqrt(unit()), angle = 2 * std::numbers::pi * unit();
      points.push_back(surface.from_world({r * std::cos(angle), r * std::sin(angle), 0}));
    }
    return points;
  }
};

double rms_mm(const std::vector<glm::dvec2>& a, const std::vector<glm::dvec2>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += glm::dot(a[i] - b[i], a[i] - b[i]);
  return 1e3 * std::sqrt(sum / static_cast<double>(a.size()));
}

struct Way {
  std::string method;
  double step_s;
  std::function<void(std::vector<glm::dvec2>&)> run;
};

std::vector<Way> ways_of(const Pool& pool, const Velocity& velocity) {
  std::vector<Way> ways;
  for (const auto& [name, step] :
       {std::pair<const char*, Step>{"Euler", euler}, {"RK2", midpoint}, {"RK4", runge_kutta}}) {
    for (const int steps : {10, 20, 40, 80, 160, 320}) {
      ways.push_back({name, kSeconds / steps,
                      [&velocity, step = step, steps](auto& points) { carry(velocity, step, steps, points); }});
    }
  }
  // What strokes are moved by: RK4 with shores, from frame to frame.
  for (const double fps : {12.5, 25.0, 50.0}) {
    ways.push_back({"rinkaku", 1 / fps, [&pool, fps](auto& points) {
                      glm::dvec2 at_last;
                      for (glm::dvec2& p : points) {
                        for (int i = 0; i < kSeconds * fps; ++i) {
                          water::carry_along(pool.flow, pool.surface, 1 / fps, p, at_last);
                        }
                      }
                    }});
  }
  return ways;
}

}  // namespace

Section water_section(const Settings& settings) {
  const Pool pool;
  const Velocity velocity = [&pool](const glm::dvec2& p) { return pool.flow.velocity(p); };
  const int count = settings.quick ? 100 : 400;
  const std::vector<glm::dvec2> start = pool.start(count, settings.seed);
  std::vector<glm::dvec2> truth = start;
  constexpr int true_steps = 8000;
  carry(velocity, runge_kutta, true_steps, truth);

  Section section;
  section.repetitions = settings.quick ? 3 : 15;
  section.intro =
      "Particles (" + std::to_string(count) + ", seed " + std::to_string(settings.seed) +
      ") carried for 4 s by the flow of a stirred round pool of 4 m radius, by steps of several lengths. The "
      "truth is RK4 with steps of half a millisecond. \"rinkaku\" is what moves strokes: RK4 that also looks "
      "for shores, a frame at a time.";
  section.table.columns = {{"method", "Method"},    {"step_s", "Step, s"},  {"error_mm", "Error, mm, RMS"},
                           {"time_ms", "Time, ms"}, {"time_low_ms", "low"}, {"time_high_ms", "high"},
                           {"cpu_ms", "CPU, ms"}};
  const std::vector<Way> ways = ways_of(pool, velocity);
  std::vector<Stopwatch> watches(ways.size());
  std::vector<double> errors(ways.size());
  for (int round = 0; round < section.repetitions; ++round) {
    for (std::size_t i = 0; i < ways.size(); ++i) {
      check_interrupted(settings);
      std::vector<glm::dvec2> points = start;
      watches[i].run([&] { ways[i].run(points); });
      errors[i] = rms_mm(points, truth);
    }
  }
  Plot plot;
  plot.title = "Where particles are after 4 s";
  plot.x.title = "time for all particles, ms";
  plot.y.title = "error, mm (root mean square)";
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const Timing time = watches[i].timing();
    section.table.rows.push_back({ways[i].method, ways[i].step_s, errors[i], time.wall_ms.median, time.wall_ms.low,
                                  time.wall_ms.high, time.cpu_ms});
    if (plot.series.empty() || plot.series.back().name != ways[i].method) {
      plot.series.push_back({ways[i].method, {}, true});
    }
    plot.series.back().points.push_back(timed_point(time.wall_ms, errors[i], ""));
  }
  plot.says = "Each line is one integrator with shorter and shorter steps. On the front: " + front_names(plot) +
              ". Looking for shores is what the product's own steps cost beyond plain RK4.";
  section.plots.push_back(std::move(plot));
  return section;
}

}  // namespace rinkaku::report
