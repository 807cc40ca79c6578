#pragma once

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace rinkaku::recordings {

/// Calls work(i) once for each i in [0, count), on every core. Calls must not depend on one another.
template <class Work>
void parallel_for(int count, const Work& work) {
  std::atomic<int> next{0};
  const auto run = [&] {
    for (int i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::jthread> threads;
  const unsigned others = std::max(1u, std::thread::hardware_concurrency()) - 1;
  for (unsigned t = 0; t < others; ++t) threads.emplace_back(run);
  run();
}

}  // namespace rinkaku::recordings
