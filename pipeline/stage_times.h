#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <string>

namespace rinkaku::pipeline {

/// How long one stage took over all frames, in memory that does not grow with their number: a histogram whose
/// percentiles are right to 1 %.
class StageTimes {
 public:
  void add(std::chrono::nanoseconds duration);

  std::int64_t count() const { return count_; }
  double mean_ms() const { return count_ > 0 ? total_ns_ / 1e6 / static_cast<double>(count_) : 0; }
  double max_ms() const { return static_cast<double>(max_ns_) / 1e6; }
  /// `fraction` in [0, 1]: 0.5 is the median. 0 if nothing was added.
  double percentile_ms(double fraction) const;

 private:
  // 64 steps an octave from 1 microsecond to over an hour.
  static constexpr int steps = 64, octaves = 33;
  std::array<std::int64_t, steps * octaves> bins_{};
  std::int64_t count_ = 0;
  std::int64_t max_ns_ = 0;
  double total_ns_ = 0;
};

}  // namespace rinkaku::pipeline
