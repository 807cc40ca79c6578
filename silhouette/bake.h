#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "silhouette/reduce.h"
#include "silhouette/surface.h"
#include "silhouette/view_regions.h"

namespace rinkaku::silhouette {

struct BakeOptions {
  ViewSpace space = RegionLayout{};
  ReduceOptions reduce;
  int threads = 0;  ///< 0: one a core. The result is the same for any number.
};

/// What came of a bake. Ratios are of the matte's triangles to the whole list's (see full_list()).
struct BakeReport {
  std::uint32_t regions = 0;
  double seconds = 0;
  std::uint64_t bytes = 0;             ///< of the whole file
  std::uint64_t triangles_full = 0;    ///< drawn without regions
  std::uint64_t triangles_stored = 0;  ///< over all regions: silhouette, hidden and front meshes, each once
  double mean_ratio = 0;
  double max_ratio = 0;
  double mean_least_ratio = 0;  ///< with the silhouette mesh whole and the fewest front triangles possible
  double hidden_gain = 0;       ///< share of the matte's triangles that hidden ones would have added back
};

struct Baked {
  std::vector<std::uint8_t> file;  ///< what RegionFile reads
  BakeReport report;
};

/// Reduces a surface for every region of a view space, and packs the result.
///
/// `progress(done, total)` is called after each region, from any of the threads but one at a time. `stop` may be set
/// from another thread or a signal handler: nothing is returned then, within the time of a region.
/// Throws Error (Input) if the view space is out of its limits. Cost: see Reducer, times regions, over threads.
std::optional<Baked> bake(const Surface& surface, const BakeOptions& options = {},
                          const std::function<void(std::uint32_t done, std::uint32_t total)>& progress = {},
                          const std::atomic<bool>* stop = nullptr);

}  // namespace rinkaku::silhouette
