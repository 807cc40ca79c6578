// Time of each method of curvature on a torus of 63,684 points (R = 1, r = 0.7): the CPU's on one core, the GPU's (or
// Mesa's llvmpipe, on all cores) with the wait for its end.

#include "outline/curvature.h"

#include <array>
#include <vector>

#include <benchmark/benchmark.h>

#include "mesh/topology.h"
#include "outline/local_thickness.h"
#include "outline/pass/curvature_pass.h"
#include "pipeline/frame/error.h"
#include "pipeline/gl/context.h"
#include "report/sections/shapes.h"

namespace {

using namespace rinkaku;

const mesh::Topology& surface() {
  static const mesh::Topology topology = mesh::topology(report::Torus{}.mesh(366, 174));  // 63,684 points
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

// Once for an object whose line follows curvature.
void thickness(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(outline::local_thickness(surface()).data());
}
BENCHMARK(thickness)->Unit(benchmark::kMillisecond);

void set_up(benchmark::State& state, outline::CurvatureMethod method) {
  for (auto _ : state) benchmark::DoNotOptimize(outline::CurvatureSolver(surface(), method).stars().corners.data());
}
BENCHMARK_CAPTURE(set_up, icnc, outline::CurvatureMethod::Icnc)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(set_up, quadric, outline::CurvatureMethod::Quadric)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
