#pragma once

#include <functional>
#include <vector>

namespace rinkaku::report {

/// What repeated measurements gave.
struct Spread {
  double median = 0;
  double low = 0;   ///< lower quartile
  double high = 0;  ///< upper quartile
};

/// Quartiles lie at the values a quarter and three quarters of the way through the sorted ones, between two of them by
/// straight interpolation. All 0 if there are none.
Spread spread(std::vector<double> values);

/// How long something took, in milliseconds.
struct Timing {
  Spread wall_ms;
  double cpu_ms = 0;  ///< of all threads of this process; median
};

/// Collects times of one thing that is run again and again.
class Stopwatch {
 public:
  /// Runs `work` once. Returns its wall time in milliseconds.
  double run(const std::function<void()>& work);
  /// A measurement that was taken elsewhere.
  void add(double wall_ms, double cpu_ms);
  Timing timing() const { return {spread(wall_ms_), spread(cpu_ms_).median}; }
  int runs() const { return static_cast<int>(wall_ms_.size()); }

 private:
  std::vector<double> wall_ms_, cpu_ms_;
};

}  // namespace rinkaku::report
