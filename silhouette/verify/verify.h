#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "silhouette/region_file.h"
#include "silhouette/surface.h"
#include "silhouette/verify/check_views.h"

namespace rinkaku::silhouette {

struct VerifyOptions {
  std::uint64_t eyes = 2000;  ///< to compare
  CheckViewOptions views;
};

/// A view in which mattes differ: CheckViews::view(eye) shows it again.
struct Mismatch {
  std::uint64_t eye = 0;
  std::int64_t pixels = 0;
  std::string description;
};

struct VerifyReport {
  std::uint64_t eyes = 0;             ///< compared
  std::uint64_t eyes_too_far = 0;     ///< not compared: there the whole surface is drawn, see least_radius_px()
  std::uint64_t eyes_with_edges = 0;  ///< in whose mattes there is a silhouette to get wrong
  std::int64_t mismatch_px_max = 0;
  std::int64_t mismatch_px_total = 0;
  double triangles_mean_ratio = 0;              ///< of the regions' lists, over the eyes, to the whole surface's
  double draw_ms_full = 0, draw_ms_region = 0;  ///< medians over the eyes, wall clock
  double draw_cpu_ms_full = 0, draw_cpu_ms_region = 0;  ///< medians, all threads
  double draw_ratio = 0;                                ///< median over the eyes of full / region, CPU time
  std::vector<Mismatch> mismatches;                     ///< in the order of the eyes
};

/// Compares the mattes of a baked file's regions with the whole surface's from many eyes (see CheckViews).
///
/// `progress(done, total)` is called after each eye; `stop` ends it early, with what was found so far.
/// Throws Error (Input) if the file belongs to another mesh, (Runtime) if the driver can't draw such pictures. Needs a
/// current GL context. Cost: two mattes an eye, for 20,000 triangles some 20 ms on software OpenGL.
VerifyReport verify(const RegionFile& file, const Surface& surface, const VerifyOptions& options,
                    const std::function<void(std::uint64_t done, std::uint64_t total)>& progress = {},
                    const std::atomic<bool>* stop = nullptr);

}  // namespace rinkaku::silhouette
