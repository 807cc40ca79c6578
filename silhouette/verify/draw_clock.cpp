#include "silhouette/verify/draw_clock.h"

#include <ctime>

#include <epoxy/gl.h>

namespace rinkaku::silhouette {
namespace {

double now_ms(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

}  // namespace

DrawTime draw_time(const std::function<void()>& draw) {
  glFinish();
  const double wall = now_ms(CLOCK_MONOTONIC), cpu = now_ms(CLOCK_PROCESS_CPUTIME_ID);
  draw();
  glFinish();
  return {now_ms(CLOCK_MONOTONIC) - wall, now_ms(CLOCK_PROCESS_CPUTIME_ID) - cpu};
}

}  // namespace rinkaku::silhouette
