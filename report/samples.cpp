#include "report/samples.h"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace rinkaku::report {
namespace {

double now_ms(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

}  // namespace

Spread spread(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&values](double part) {
    const double place = part * static_cast<double>(values.size() - 1), whole = std::floor(place);
    const auto i = static_cast<std::size_t>(whole);
    const double next = values[std::min(i + 1, values.size() - 1)];
    return values[i] + (next - values[i]) * (place - whole);
  };
  return {at(0.5), at(0.25), at(0.75)};
}

double Stopwatch::run(const std::function<void()>& work) {
  const double wall = now_ms(CLOCK_MONOTONIC), cpu = now_ms(CLOCK_PROCESS_CPUTIME_ID);
  work();
  const double took_ms = now_ms(CLOCK_MONOTONIC) - wall;
  add(took_ms, now_ms(CLOCK_PROCESS_CPUTIME_ID) - cpu);
  return took_ms;
}

void Stopwatch::add(double wall_ms, double cpu_ms) {
  wall_ms_.push_back(wall_ms);
  cpu_ms_.push_back(cpu_ms);
}

}  // namespace rinkaku::report
