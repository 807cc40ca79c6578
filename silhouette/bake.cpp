#include "silhouette/bake.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <mutex>
#include <thread>

#include "pipeline/frame/error.h"
#include "silhouette/region_pack.h"

namespace rinkaku::silhouette {
namespace {

/// What is added up over regions, kept per region so that the sums don't depend on the order.
struct RegionCounts {
  std::uint64_t matte = 0;
  std::uint64_t hidden = 0;
  std::uint64_t least = 0;
  std::uint64_t stored = 0;
};

RegionCounts count(const RegionMeshes& meshes) {
  RegionCounts out;
  out.matte = meshes.silhouette + meshes.matte_front.size();
  out.hidden = meshes.hidden;
  out.least = std::uint64_t{meshes.silhouette} + meshes.hidden + meshes.front_least;
  out.stored = out.matte + meshes.hidden + meshes.depth_front.size();
  return out;
}

/// The regions, worked off by several threads: each takes the next one.
class Baker {
 public:
  Baker(const Surface& surface, const BakeOptions& options,
        const std::function<void(std::uint32_t, std::uint32_t)>& progress, const std::atomic<bool>* stop)
      : surface_(surface), options_(options), progress_(progress), stop_(stop) {
    packed_.resize(region_count(options.space));
    counts_.resize(packed_.size());
  }

  /// False if it was stopped.
  bool run() {
    int threads = options_.threads > 0 ? options_.threads : static_cast<int>(std::thread::hardware_concurrency());
    threads = std::clamp(threads, 1, std::max(1, static_cast<int>(packed_.size())));
    {
      std::vector<std::jthread> others;
      for (int i = 1; i < threads; ++i) others.emplace_back([this] { work(); });
      work();
    }
    if (failure_) std::rethrow_exception(failure_);
    return !stopped();
  }

  const std::vector<PackedRegion>& packed() const { return packed_; }

  BakeReport report(double seconds, std::uint64_t bytes) const {
    BakeReport out;
    out.regions = static_cast<std::uint32_t>(packed_.size());
    out.seconds = seconds;
    out.bytes = bytes;
    out.triangles_full = surface_.triangles.size() + surface_.treatment.two_sided_triangles;
    RegionCounts sum;
    std::uint64_t most = 0;
    for (const RegionCounts& c : counts_) {
      sum.matte += c.matte;
      sum.hidden += c.hidden;
      sum.least += c.least;
      sum.stored += c.stored;
      most = std::max(most, c.matte);
    }
    const double whole = static_cast<double>(out.triangles_full) * static_cast<double>(packed_.size());
    out.triangles_stored = sum.stored;
    out.mean_ratio = static_cast<double>(sum.matte) / whole;
    out.max_ratio = static_cast<double>(most) / static_cast<double>(out.triangles_full);
    out.mean_least_ratio = static_cast<double>(sum.least) / whole;
    const std::uint64_t with_hidden = sum.matte + sum.hidden;
    out.hidden_gain = with_hidden > 0 ? static_cast<double>(sum.hidden) / static_cast<double>(with_hidden) : 0.0;
    return out;
  }

 private:
  bool stopped() const { return stop_ != nullptr && stop_->load(std::memory_order_relaxed); }

  void work() {
    try {
      Reducer reducer(surface_);
      RegionPacker packer(surface_);
      RegionMeshes meshes;
      for (;;) {
        const std::uint32_t region = next_.fetch_add(1);
        if (region >= packed_.size() || stopped() || failed_) return;
        reducer.reduce(view_region(options_.space, region), options_.reduce, meshes);
        packed_[region] = packer.pack(meshes);
        counts_[region] = count(meshes);
        const std::lock_guard lock(mutex_);
        ++done_;
        if (progress_) progress_(done_, static_cast<std::uint32_t>(packed_.size()));
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      failed_ = true;
    }
  }

  const Surface& surface_;
  const BakeOptions& options_;
  const std::function<void(std::uint32_t, std::uint32_t)>& progress_;
  const std::atomic<bool>* stop_;
  std::vector<PackedRegion> packed_;
  std::vector<RegionCounts> counts_;
  std::atomic<std::uint32_t> next_{0};
  std::atomic<bool> failed_{false};
  std::mutex mutex_;  // guards what follows
  std::uint32_t done_ = 0;
  std::exception_ptr failure_;
};

}  // namespace

std::optional<Baked> bake(const Surface& surface, const BakeOptions& options,
                          const std::function<void(std::uint32_t done, std::uint32_t total)>& progress,
                          const std::atomic<bool>* stop) {
  check(options.space, "bake");
  if (!(options.reduce.depth_distance >= 0 && options.reduce.depth_distance < 1)) {
    throw input_error("bake", "the depth distance is not between 0 and 1 object radii", "give a small distance");
  }
  const auto start = std::chrono::steady_clock::now();
  Baker baker(surface, options, progress, stop);
  if (!baker.run()) return std::nullopt;
  Baked out;
  out.file = region_file_bytes(surface, options.space, options.reduce.depth_distance, baker.packed());
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  out.report = baker.report(seconds.count(), out.file.size());
  return out;
}

}  // namespace rinkaku::silhouette
