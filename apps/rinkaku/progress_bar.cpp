#include "apps/rinkaku/progress_bar.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include <unistd.h>

namespace rinkaku::app {

ProgressBar::ProgressBar(const char* things, const char* rate)
    : things_(things), rate_(rate), on_terminal_(isatty(STDERR_FILENO) == 1), start_(Clock::now()), last_(start_) {}

ProgressBar::~ProgressBar() {
  if (drawn_) std::fputs("\r\033[K", stderr);
}

void ProgressBar::update(std::int64_t done, std::int64_t total) {
  if (!on_terminal_) return;
  const Clock::time_point now = Clock::now();
  if (drawn_ && now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  drawn_ = true;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double per_second = seconds > 0 ? static_cast<double>(done) / seconds : 0;
  if (total <= 0) {
    std::fprintf(stderr, "\r\033[K%lld %s, %.1f %s", static_cast<long long>(done), things_, per_second, rate_);
    return;
  }
  constexpr int width = 30;
  const int filled = static_cast<int>(std::min<std::int64_t>(done * width / total, width));
  const double left_s = per_second > 0 ? static_cast<double>(std::max<std::int64_t>(total - done, 0)) / per_second : 0;
  const std::string bar = std::string(filled, '#') + std::string(width - filled, '.');
  std::fprintf(stderr, "\r\033[K[%s] %lld/%lld %s, %.1f %s, %.0f s left", bar.c_str(), static_cast<long long>(done),
               static_cast<long long>(total), things_, per_second, rate_, left_s);
}

}  // namespace rinkaku::app
