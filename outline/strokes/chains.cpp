#include "outline/strokes/chains.h"

#include <algorithm>
#include <array>
#include <utility>

namespace rinkaku::outline {

Chains::Chains(std::span<const std::uint32_t> welded) : welded_(welded.begin(), welded.end()) {
  const std::size_t points = welded.empty() ? 0 : *std::max_element(welded.begin(), welded.end()) + std::size_t{1};
  first_from_.assign(points, kNoSegment);
  ends_.assign(points, 0);
}

std::uint32_t Chains::take_from(std::uint32_t point) {
  std::uint32_t segment = first_from_[point];
  while (segment != kNoSegment && used_[segment] != 0) segment = next_from_[segment];
  first_from_[point] = segment == kNoSegment ? kNoSegment : next_from_[segment];
  return segment;
}

void Chains::walk(std::span<const Segment> segments, std::uint32_t start) {
  Chain chain;
  chain.first = static_cast<std::uint32_t>(vertices_.size());
  vertices_.push_back(segments[start].from);
  steps_.push_back(start);
  for (std::uint32_t segment = start; segment != kNoSegment; segment = take_from(welded_[segments[segment].to])) {
    used_[segment] = 1;
    vertices_.push_back(segments[segment].to);
    steps_.push_back(segment);
  }
  chain.count = static_cast<std::uint32_t>(vertices_.size()) - chain.first;
  chain.closed = chain.count > 3 && welded_[vertices_.back()] == welded_[vertices_[chain.first]];
  chains_.push_back(chain);
}

void Chains::link(std::span<const Segment> segments) {
  chains_.clear();
  vertices_.clear();
  steps_.clear();
  next_from_.assign(segments.size(), kNoSegment);
  used_.assign(segments.size(), 0);
  for (std::size_t i = segments.size(); i-- > 0;) {
    std::uint32_t& first = first_from_[welded_[segments[i].from]];
    next_from_[i] = std::exchange(first, static_cast<std::uint32_t>(i));
    ++ends_[welded_[segments[i].from]];
    --ends_[welded_[segments[i].to]];
  }
  // Open chains first, from where more begin than end; what is left are loops.
  for (const bool open : {true, false}) {
    for (std::uint32_t i = 0; i < segments.size(); ++i) {
      if (used_[i] != 0 || (open && ends_[welded_[segments[i].from]] <= 0)) continue;
      if (open) --ends_[welded_[segments[i].from]];
      walk(segments, i);
    }
  }
  for (const Segment& s : segments) {
    for (const std::uint32_t vertex : {s.from, s.to})
      first_from_[welded_[vertex]] = kNoSegment, ends_[welded_[vertex]] = 0;
  }
}

std::vector<Segment> in_order(std::span<const Segment> segments, std::span<const std::uint32_t> welded) {
  std::vector<std::vector<std::uint32_t>> at(
      welded.empty() ? 0 : *std::max_element(welded.begin(), welded.end()) + std::size_t{1});
  for (std::uint32_t i = 0; i < segments.size(); ++i) {
    at[welded[segments[i].from]].push_back(i);
    at[welded[segments[i].to]].push_back(i);
  }
  std::vector<bool> used(segments.size());
  std::vector<Segment> ordered;
  const auto walk = [&](std::uint32_t segment, bool turned) {
    while (true) {
      used[segment] = true;
      Segment s = segments[segment];
      if (turned) std::swap(s.from, s.to);
      ordered.push_back(s);
      const std::vector<std::uint32_t>& here = at[welded[s.to]];
      if (here.size() != 2) return;
      const std::uint32_t next = here[0] == segment ? here[1] : here[0];
      if (used[next]) return;
      turned = welded[segments[next].from] != welded[s.to];
      segment = next;
    }
  };
  for (const bool open : {true, false}) {
    for (std::uint32_t i = 0; i < segments.size(); ++i) {
      for (const bool turned : {false, true}) {
        const std::uint32_t begin = turned ? segments[i].to : segments[i].from;
        if (!used[i] && (!open || at[welded[begin]].size() != 2)) walk(i, turned);
      }
    }
  }
  return ordered;
}

}  // namespace rinkaku::outline
