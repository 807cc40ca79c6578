#include "outline/ring_smoothing.h"

#include <cstddef>
#include <numeric>

namespace rinkaku::outline {

RingSmoothing::RingSmoothing(const mesh::Topology& topology, int times)
    : times_(times),
      neighbours_(topology),
      all_(topology.points.size()),
      seen_at_(topology.points.size(), 0),
      smoothed_(topology.points.size()) {
  std::iota(all_.begin(), all_.end(), 0u);
  rings_.reserve(all_.size());
}

std::span<const std::uint32_t> RingSmoothing::everywhere() {
  whole_ = true;
  return all_;
}

std::span<const std::uint32_t> RingSmoothing::around(std::span<const std::uint32_t> wanted) {
  ++call_;
  rings_.clear();
  ring_ends_.clear();
  const auto add = [&](std::uint32_t p) {
    if (seen_at_[p] == call_) return;
    seen_at_[p] = call_;
    rings_.push_back(p);
  };
  for (const std::uint32_t p : wanted) add(p);
  ring_ends_.push_back(static_cast<std::uint32_t>(rings_.size()));
  std::size_t done = 0;
  const std::size_t most = all_.size() / 3;
  for (int i = 0; i < times_; ++i) {
    if (rings_.size() >= most) return everywhere();
    const std::size_t end = rings_.size();
    for (; done < end; ++done) {
      for (const std::uint32_t q : neighbours_.at(rings_[done])) add(q);
    }
    ring_ends_.push_back(static_cast<std::uint32_t>(rings_.size()));
  }
  whole_ = false;
  return rings_;
}

void RingSmoothing::smooth(std::span<float> values) {
  for (int i = times_; i-- > 0;) {
    step(whole_ ? std::span<const std::uint32_t>(all_)
                : std::span<const std::uint32_t>(rings_).first(ring_ends_[static_cast<std::size_t>(i)]),
         values);
  }
}

void RingSmoothing::step(std::span<const std::uint32_t> of, std::span<float> values) {
  for (const std::uint32_t p : of) {
    const std::span<const std::uint32_t> around = neighbours_.at(p);
    float sum = 0;
    for (const std::uint32_t q : around) sum += values[q];
    smoothed_[p] = around.empty() ? values[p] : (values[p] + sum / static_cast<float>(around.size())) / 2;
  }
  for (const std::uint32_t p : of) values[p] = smoothed_[p];
}

}  // namespace rinkaku::outline
