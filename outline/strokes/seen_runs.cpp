#include "outline/strokes/seen_runs.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace rinkaku::outline {
namespace {

glm::vec2 seen_at(const glm::mat4& to_pixels, const glm::vec3& position) {
  const glm::vec3 seen(to_pixels * glm::vec4(position, 1));
  return glm::vec2(seen) / std::max(seen.z, 1e-3f);
}

}  // namespace

void SeenRuns::part(const Chains& chains, std::uint32_t first_hidden, const PositionView& positions,
                    const glm::mat4& to_pixels, float longest_px) {
  runs_.clear();
  vertices_.clear();
  for (const Chain& chain : chains.chains()) {
    const auto vertices = chains.vertices().subspan(chain.first, chain.count);
    const auto steps = chains.steps().subspan(chain.first, chain.count);
    // Step i leads from vertex i to i + 1.
    const std::size_t n = chain.count - 1;
    lengths_px_.resize(n);
    hidden_.resize(n);
    glm::vec2 before = seen_at(to_pixels, positions[vertices[0]]);
    for (std::size_t i = 0; i < n; ++i) {
      const glm::vec2 here = seen_at(to_pixels, positions[vertices[i + 1]]);
      lengths_px_[i] = glm::length(here - before);
      hidden_[i] = steps[i + 1] >= first_hidden ? 1 : 0;
      before = here;
    }
    // Short hidden stretches between seen ones are seen. On a closed chain the first stretch goes on with the last.
    for (std::size_t i = 0; i < n;) {
      std::size_t end = i;
      float length_px = 0;
      while (end < n && hidden_[end] == hidden_[i]) length_px += lengths_px_[end++];
      const bool between = chain.closed || (i > 0 && end < n);
      if (hidden_[i] != 0 && between && length_px <= longest_px) {
        std::fill(hidden_.begin() + static_cast<std::ptrdiff_t>(i), hidden_.begin() + static_cast<std::ptrdiff_t>(end),
                  std::uint8_t{0});
      }
      i = end;
    }
    part(vertices, chain.closed);
  }
}

void SeenRuns::part(std::span<const std::uint32_t> vertices, bool closed) {
  const std::size_t n = hidden_.size();
  const auto break_at = std::find(hidden_.begin(), hidden_.end(), std::uint8_t{1});
  if (break_at == hidden_.end()) {
    runs_.push_back(
        {static_cast<std::uint32_t>(vertices_.size()), static_cast<std::uint32_t>(vertices.size()), closed});
    vertices_.insert(vertices_.end(), vertices.begin(), vertices.end());
    return;
  }
  // Around a closed chain from where it is hidden.
  const std::size_t start = closed ? static_cast<std::size_t>(break_at - hidden_.begin()) : 0;
  bool open = false;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = (start + k) % n;
    if (hidden_[i] != 0) {
      open = false;
      continue;
    }
    if (!open) {
      runs_.push_back({static_cast<std::uint32_t>(vertices_.size()), 1, false});
      vertices_.push_back(vertices[i]);
      open = true;
    }
    vertices_.push_back(vertices[i + 1]);
    ++runs_.back().count;
  }
}

}  // namespace rinkaku::outline
