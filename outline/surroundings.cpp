#include "outline/surroundings.h"

#include <numeric>

namespace rinkaku::outline {

Surroundings::Surroundings(const mesh::Topology& topology, int rings)
    : rings_(rings), neighbours_(topology), all_(topology.points.size()), seen_at_(topology.points.size(), 0) {
  std::iota(all_.begin(), all_.end(), 0u);
  found_.reserve(all_.size());
}

void Surroundings::look_around(std::span<const std::uint32_t> wanted) {
  ++look_;
  found_.clear();
  ends_.clear();
  whole_ = false;
  const auto add = [&](std::uint32_t p) {
    if (seen_at_[p] == look_) return;
    seen_at_[p] = look_;
    found_.push_back(p);
  };
  for (const std::uint32_t p : wanted) add(p);
  ends_.push_back(static_cast<std::uint32_t>(found_.size()));
  std::size_t done = 0;
  const std::size_t most = all_.size() / 3;
  for (int i = 0; i < rings_; ++i) {
    if (found_.size() >= most) {
      look_everywhere();
      return;
    }
    const std::size_t end = found_.size();
    for (; done < end; ++done) {
      for (const std::uint32_t q : neighbours_.at(found_[done])) add(q);
    }
    ends_.push_back(static_cast<std::uint32_t>(found_.size()));
  }
}

}  // namespace rinkaku::outline
