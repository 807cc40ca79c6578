#include "pipeline/stage_times.h"

#include <algorithm>
#include <cmath>

namespace rinkaku::pipeline {
namespace {

constexpr double first_ns = 1000;

}  // namespace

void StageTimes::add(std::chrono::nanoseconds duration) {
  const double ns = static_cast<double>(duration.count());
  const int bin = ns > first_ns ? static_cast<int>(std::log2(ns / first_ns) * steps) : 0;
  ++bins_[std::clamp(bin, 0, static_cast<int>(bins_.size()) - 1)];
  ++count_;
  total_ns_ += ns;
  max_ns_ = std::max<std::int64_t>(max_ns_, duration.count());
}

double StageTimes::percentile_ms(double fraction) const {
  if (count_ == 0) return 0;
  const auto wanted = static_cast<std::int64_t>(std::ceil(fraction * static_cast<double>(count_)));
  std::int64_t seen = 0;
  for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
    seen += bins_[bin];
    if (seen >= std::max<std::int64_t>(wanted, 1)) {
      const double middle_ns = first_ns * std::exp2((static_cast<double>(bin) + 0.5) / steps);
      return std::min(middle_ns / 1e6, max_ms());
    }
  }
  return max_ms();
}

}  // namespace rinkaku::pipeline
