#pragma once

#include <chrono>
#include <cstdint>

namespace rinkaku::app {

/// A bar on standard error that grows as frames, or what else is counted, are done; silent where standard error is no
/// terminal.
class ProgressBar {
 public:
  /// `things` and `rate` must outlive the bar.
  explicit ProgressBar(const char* things = "frames", const char* rate = "fps");
  /// Takes the bar off the line.
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `total` 0 where it is not known. Redraws ten times a second at most.
  void update(std::int64_t done, std::int64_t total);

 private:
  using Clock = std::chrono::steady_clock;
  const char* things_;
  const char* rate_;
  bool on_terminal_;
  bool drawn_ = false;
  Clock::time_point start_, last_;
};

}  // namespace rinkaku::app
