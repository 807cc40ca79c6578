#include "silhouette/verify/verify.h"

#include <algorithm>

#include "silhouette/verify/matte_comparison.h"

namespace rinkaku::silhouette {
namespace {

double median(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Times {
  std::vector<double> full, region, full_cpu, region_cpu, ratio;

  void add(const MatteDifference& d) {
    full.push_back(d.full.wall_ms);
    region.push_back(d.other.wall_ms);
    full_cpu.push_back(d.full.cpu_ms);
    region_cpu.push_back(d.other.cpu_ms);
    if (d.other.cpu_ms > 0) ratio.push_back(d.full.cpu_ms / d.other.cpu_ms);
  }
};

}  // namespace

VerifyReport verify(const RegionFile& file, const Surface& surface, const VerifyOptions& options,
                    const std::function<void(std::uint64_t, std::uint64_t)>& progress, const std::atomic<bool>* stop) {
  file.must_belong_to(surface);
  CheckViews views(file.space(), surface.frame, options.views);
  MatteComparison comparison(surface);
  VerifyReport report;
  Times times;
  std::vector<std::uint32_t> indices;
  double ratios = 0;
  const double least_px = least_radius_px(surface);
  for (std::uint64_t eye = 0; report.eyes < options.eyes && !(stop != nullptr && *stop); ++eye) {
    const CheckView view = views.view(eye);
    if (view.radius_px < least_px) {
      ++report.eyes_too_far;
      // Should a mesh be so fine that hardly any eye is near enough, there is an end all the same.
      if (report.eyes_too_far > 10 * options.eyes) break;
      continue;
    }
    file.decode(view.region, Product::Matte, indices);
    const MatteDifference difference = comparison.compare(view, indices);
    ++report.eyes;
    report.eyes_with_edges += difference.has_edge ? 1 : 0;
    report.mismatch_px_total += difference.mismatch_px;
    report.mismatch_px_max = std::max(report.mismatch_px_max, difference.mismatch_px);
    if (difference.mismatch_px > 0) report.mismatches.push_back({eye, difference.mismatch_px, view.description});
    ratios += static_cast<double>(indices.size()) / static_cast<double>(comparison.full_indices().size());
    times.add(difference);
    if (progress) progress(report.eyes, options.eyes);
  }
  report.triangles_mean_ratio = report.eyes > 0 ? ratios / static_cast<double>(report.eyes) : 0;
  report.draw_ms_full = median(times.full);
  report.draw_ms_region = median(times.region);
  report.draw_cpu_ms_full = median(times.full_cpu);
  report.draw_cpu_ms_region = median(times.region_cpu);
  report.draw_ratio = median(times.ratio);
  return report;
}

}  // namespace rinkaku::silhouette
