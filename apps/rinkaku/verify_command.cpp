#include <algorithm>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "apps/rinkaku/call_values.h"
#include "apps/rinkaku/interrupt.h"
#include "apps/rinkaku/json_output.h"
#include "apps/rinkaku/matte_commands.h"
#include "apps/rinkaku/progress_bar.h"
#include "apps/rinkaku/surface_file.h"
#include "pipeline/frame/error.h"
#include "pipeline/gl/context.h"
#include "silhouette/verify/verify.h"

namespace rinkaku::app {
namespace {

nlohmann::json to_json(const silhouette::VerifyReport& report) {
  nlohmann::json mismatches = nlohmann::json::array();
  for (const silhouette::Mismatch& m : report.mismatches) {
    mismatches.push_back({{"eye", m.eye}, {"pixels", m.pixels}, {"view", m.description}});
  }
  return {{"eyes", report.eyes},
          {"eyes_too_far", report.eyes_too_far},
          {"eyes_with_edges", report.eyes_with_edges},
          {"mismatch_px_max", report.mismatch_px_max},
          {"mismatch_px_total", report.mismatch_px_total},
          {"triangles_mean_ratio", report.triangles_mean_ratio},
          {"draw_ms_full", report.draw_ms_full},
          {"draw_ms_region", report.draw_ms_region},
          {"draw_cpu_ms_full", report.draw_cpu_ms_full},
          {"draw_cpu_ms_region", report.draw_cpu_ms_region},
          {"draw_ratio", report.draw_ratio},
          {"mismatches", mismatches}};
}

void print(const silhouette::VerifyReport& report) {
  std::printf(
      "%llu eyes, %llu of them with a silhouette in the picture; %llu more are so far off that the mesh is drawn "
      "whole\n",
      static_cast<unsigned long long>(report.eyes), static_cast<unsigned long long>(report.eyes_with_edges),
      static_cast<unsigned long long>(report.eyes_too_far));
  std::printf("%lld pixels differ in %zu eyes, at most %lld in one\n", static_cast<long long>(report.mismatch_px_total),
              report.mismatches.size(), static_cast<long long>(report.mismatch_px_max));
  std::printf("%.1f %% of the triangles on average\n", report.triangles_mean_ratio * 100);
  std::printf("drawn in %.2f ms, the whole mesh in %.2f (medians); %.2f times as fast by CPU time\n",
              report.draw_ms_region, report.draw_ms_full, report.draw_ratio);
}

}  // namespace

int verify(const VerifyCall& call) {
  silhouette::VerifyOptions options;
  options.eyes = static_cast<std::uint64_t>(call.eyes);
  options.views.seed = static_cast<std::uint64_t>(call.seed);
  if (!call.size.empty()) options.views.size_px = parse_size("--size", call.size);
  const silhouette::RegionFile file = silhouette::RegionFile::open(call.regions);
  const silhouette::Surface surface = read_surface(call.mesh);
  file.must_belong_to(surface);
  const auto context = gl::Context::headless();
  silhouette::VerifyReport report;
  {
    ProgressBar bar("eyes", "a second");
    const auto progress = [&bar](std::uint64_t done, std::uint64_t total) {
      bar.update(static_cast<std::int64_t>(done), static_cast<std::int64_t>(total));
    };
    report = silhouette::verify(file, surface, options, progress, &interrupted());
  }
  if (interrupted()) {
    throw runtime_failure(call.regions, "interrupted after " + std::to_string(report.eyes) + " eyes, in which " +
                                            std::to_string(report.mismatch_px_total) + " pixels differed");
  }
  constexpr std::size_t most_told = 10;
  for (std::size_t i = 0; i < std::min(report.mismatches.size(), most_told); ++i) {
    const silhouette::Mismatch& m = report.mismatches[i];
    std::fprintf(stderr, "rinkaku: note: eye %llu: %lld pixels differ; %s\n", static_cast<unsigned long long>(m.eye),
                 static_cast<long long>(m.pixels), m.description.c_str());
  }
  if (call.json) {
    print_json(to_json(report));
  } else {
    print(report);
  }
  return report.mismatch_px_total == 0 ? 0 : 1;
}

}  // namespace rinkaku::app
