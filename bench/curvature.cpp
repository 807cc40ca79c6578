// Time of each method of curvature on a torus of 63,684 points (R = 1, r = 0.7): the CPU's on one core, the GPU's (or
// Mesa's llvmpipe, on all cores) with the wait for its end.

#include "outline/curvature.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <benchmark/benchmark.h>

#include "mesh/assemble.h"
#include "mesh/topology.h"
#include "outline/pass/curvature_pass.h"
#include "pipeline/frame/error.h"
#include "pipeline/gl/context.h"

namespace {

using namespace rinkaku;

mesh::Topology torus() {
  constexpr std::uint32_t around = 366, across = 174;  // 63,684 points
  constexpr double outer = 1, inner = 0.7, turn = 2 * std::numbers::pi;
  mesh::Soup soup;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      const double u = turn * i / around, v = turn * j / across, radius = outer + inner * std::cos(v);
      soup.positions.emplace_back(radius * std::cos(u), radius * std::sin(u), inner * std::sin(v));
      const std::uint32_t next_i = (i + 1) % around, next_j = (j + 1) % across;
      const std::uint32_t a = i * across + j, b = next_i * across + j, c = next_i * across + next_j,
                          d = i * across + next_j;
      soup.triangles.insert(soup.triangles.end(), {{a, b, c}, {a, c, d}});
    }
  }
  mesh::Part part;
  part.triangle_count = static_cast<std::uint32_t>(soup.triangles.size());
  soup.parts = {part};
  soup.materials.emplace_back();
  return mesh::topology(mesh::assemble(std::move(soup), 60).mesh);
}

const mesh::Topology& surface() {
  static const mesh::Topology topology = torus();
  return topology;
}

void every_frame(benchmark::State& state, outline::CurvatureMethod method) {
  outline::CurvatureSolver solver(surface(), method);
  for (auto _ : state) benchmark::DoNotOptimize(solver.solve(surface().points).mean.data());
  state.counters["points"] = static_cast<double>(surface().points.size());
}

BENCHMARK_CAPTURE(every_frame, icnc, outline::CurvatureMethod::Icnc)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(every_frame, meyer, outline::CurvatureMethod::Meyer)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(every_frame, automatic, outline::CurvatureMethod::Auto)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(every_frame, quadric, outline::CurvatureMethod::Quadric)->Unit(benchmark::kMillisecond);

void gpu_every_frame(benchmark::State& state) {
  try {
    const auto context = gl::Context::headless();
    state.SetLabel(context->renderer());
    const outline::FaceStars stars = outline::face_stars(surface());
    outline::CurvaturePass pass(stars, surface().points);
    std::vector<glm::vec4> points;
    for (const glm::vec3& p : surface().points) points.emplace_back(p, 1);
    const gl::StaticBuffer buffer(std::as_bytes(std::span(points)));
    std::array<std::byte, 16> last;
    for (auto _ : state) {
      pass.run(buffer.name());
      pass.curvatures().read(last);  // waits
    }
  } catch (const Error& error) {
    state.SkipWithError(error.what());
  }
}
BENCHMARK(gpu_every_frame)->Unit(benchmark::kMillisecond)->UseRealTime();

void set_up(benchmark::State& state, outline::CurvatureMethod method) {
  for (auto _ : state) benchmark::DoNotOptimize(outline::CurvatureSolver(surface(), method).stars().corners.data());
}
BENCHMARK_CAPTURE(set_up, icnc, outline::CurvatureMethod::Icnc)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(set_up, quadric, outline::CurvatureMethod::Quadric)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
