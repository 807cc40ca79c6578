#include "outline/ring_smoothing.h"

namespace rinkaku::outline {

RingSmoothing::RingSmoothing(const mesh::Topology& topology, int times)
    : points_(topology, times), smoothed_(topology.points.size()) {}

std::span<const std::uint32_t> RingSmoothing::everywhere() {
  points_.look_everywhere();
  return points_.within(points_.rings());
}

std::span<const std::uint32_t> RingSmoothing::around(std::span<const std::uint32_t> wanted) {
  points_.look_around(wanted);
  return points_.within(points_.rings());
}

void RingSmoothing::smooth(std::span<float> values) {
  for (int i = points_.rings(); i-- > 0;) step(points_.within(i), values);
}

void RingSmoothing::step(std::span<const std::uint32_t> of, std::span<float> values) {
  for (const std::uint32_t p : of) {
    const std::span<const std::uint32_t> around = points_.neighbours().at(p);
    float sum = 0;
    for (const std::uint32_t q : around) sum += values[q];
    smoothed_[p] = around.empty() ? values[p] : (values[p] + sum / static_cast<float>(around.size())) / 2;
  }
  for (const std::uint32_t p : of) values[p] = smoothed_[p];
}

}  // namespace rinkaku::outline
