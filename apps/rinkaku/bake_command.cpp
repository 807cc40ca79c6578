#include <cstdio>

#include <nlohmann/json.hpp>

#include "apps/rinkaku/interrupt.h"
#include "apps/rinkaku/json_output.h"
#include "apps/rinkaku/matte_commands.h"
#include "apps/rinkaku/progress_bar.h"
#include "apps/rinkaku/surface_file.h"
#include "pipeline/files/pending_file.h"
#include "pipeline/frame/error.h"
#include "silhouette/bake.h"
#include "silhouette/region_file.h"

namespace rinkaku::app {

int bake(const BakeCall& call) {
  const std::atomic<bool>& stop = interrupted();  // from here on: importing takes a while as well
  files::PendingFile output(call.output, call.force);
  output.must_not_be(call.mesh);
  const silhouette::Surface surface = read_surface(call.mesh);
  silhouette::BakeOptions options;
  options.space = silhouette::RegionLayout{call.cells, call.shells, call.inner_radii};
  options.reduce.depth_distance = call.depth_radii;
  options.reduce.drop_hidden = call.drop_hidden;
  std::optional<silhouette::Baked> baked;
  {
    ProgressBar bar("regions", "a second");
    baked = silhouette::bake(
        surface, options, [&bar](std::uint32_t done, std::uint32_t total) { bar.update(done, total); }, &stop);
  }
  if (!baked) throw runtime_failure(call.output, "interrupted: nothing was written");
  output.write(baked->file);
  const silhouette::BakeReport& report = baked->report;
  const silhouette::Treatment& treated = surface.treatment;
  if (call.json) {
    print_json({{"output", call.output},
                {"regions", report.regions},
                {"seconds", report.seconds},
                {"bytes", report.bytes},
                {"triangles_full", report.triangles_full},
                {"triangles_stored", report.triangles_stored},
                {"triangles_mean_ratio", report.mean_ratio},
                {"triangles_max_ratio", report.max_ratio},
                {"triangles_least_ratio", report.mean_least_ratio},
                {"hidden_gain", report.hidden_gain},
                {"repaired_components", treated.repaired_components},
                {"two_sided_components", treated.two_sided_components},
                {"two_sided_triangles", treated.two_sided_triangles}});
    return 0;
  }
  std::printf("%s: %u regions in %.1f s, %.1f MB; mattes need %.1f %% of %llu triangles on average, at most %.1f %%\n",
              call.output.c_str(), report.regions, report.seconds, static_cast<double>(report.bytes) / 1e6,
              report.mean_ratio * 100, static_cast<unsigned long long>(report.triangles_full), report.max_ratio * 100);
  if (call.drop_hidden) {
    std::printf("%.1f %% of these were left out as the front mesh hides them\n", report.hidden_gain * 100);
  }
  if (treated.two_sided_components > 0) {
    std::printf("%u parts that are open or can't be wound alike are drawn from both sides\n",
                treated.two_sided_components);
  }
  return 0;
}

}  // namespace rinkaku::app
