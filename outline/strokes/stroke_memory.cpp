#include "outline/strokes/stroke_memory.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace rinkaku::outline {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;
constexpr float kCell_px = 8;
constexpr float kFarthest_px = 7;  // that a line may have moved between two frames beside itself
constexpr std::size_t kEvery = 2;  // samples

std::size_t cell_of(int x, int y) {
  const auto mixed = static_cast<std::uint32_t>(x) * 73856093u ^ static_cast<std::uint32_t>(y) * 19349663u;
  return (mixed ^ mixed >> 12) % 4096;
}
int cell_coordinate(float px) { return static_cast<int>(std::floor(std::clamp(px, -1e6f, 1e6f) / kCell_px)); }

glm::vec2 way_at(const StrokePath& path, std::size_t i) {
  const std::span<const StrokeSample> samples = path.samples();
  const std::size_t after = std::min(i + 1, samples.size() - 1), before = after - 1;
  const glm::vec2 way = samples[after].px - samples[before].px;
  const float length = glm::length(way);
  return length > 0 ? way / length : glm::vec2(0);
}

}  // namespace

void StrokeMemory::begin(const LinePoints& points, const glm::mat4& to_pixels) {
  std::swap(last_, now_);
  now_.clear();
  lines_ = 0;
  cells_.fill(kNone);
  for (std::uint32_t i = 0; i < last_.size(); ++i) {
    Place& place = last_[i];
    const glm::vec3 seen(to_pixels * glm::vec4(place.here.on(points), 1));
    const glm::vec3 ahead(to_pixels * glm::vec4(place.ahead.on(points), 1));
    if (!(seen.z > 1e-3f) || !(ahead.z > 1e-3f)) continue;
    place.px = glm::vec2(seen) / seen.z;
    place.way = glm::vec2(ahead) / ahead.z - place.px;
    const float length = glm::length(place.way);
    if (length > 0) place.way /= length;
    std::uint32_t& cell = cells_[cell_of(cell_coordinate(place.px.x), cell_coordinate(place.px.y))];
    place.next = cell;
    cell = i;
  }
}

const StrokeMemory::Place* StrokeMemory::nearest(const glm::vec2& px, const glm::vec2& way) const {
  const Place* found = nullptr;
  float least = kFarthest_px * kFarthest_px;
  const int cx = cell_coordinate(px.x), cy = cell_coordinate(px.y);
  for (int y = cy - 1; y <= cy + 1; ++y) {
    for (int x = cx - 1; x <= cx + 1; ++x) {
      for (std::uint32_t i = cells_[cell_of(x, y)]; i != kNone; i = last_[i].next) {
        const glm::vec2 apart = last_[i].px - px;
        const float squared = glm::dot(apart, apart);
        if (squared >= least || glm::dot(last_[i].way, way) < 0.7f) continue;
        least = squared;
        found = &last_[i];
      }
    }
  }
  return found;
}

// Leaves the votes of the line that has most. False if too few agree on any.
bool StrokeMemory::keep_most_voted() {
  std::uint32_t lines = 0;
  for (const Vote& vote : votes_) lines = std::max(lines, vote.line + 1);
  counts_.assign(lines, 0);
  for (const Vote& vote : votes_) ++counts_[vote.line];
  if (counts_.empty()) return false;
  const auto most = static_cast<std::uint32_t>(std::max_element(counts_.begin(), counts_.end()) - counts_.begin());
  if (counts_[most] < 2) return false;
  std::erase_if(votes_, [most](const Vote& vote) { return vote.line != most; });
  return true;
}

StrokeFit StrokeMemory::fit_votes() const {
  sorted_.clear();
  for (const Vote& vote : votes_) sorted_.push_back(vote.u_px - vote.way_px);
  const auto middle = sorted_.begin() + static_cast<std::ptrdiff_t>(sorted_.size() / 2);
  std::nth_element(sorted_.begin(), middle, sorted_.end());
  StrokeFit fit{1, *middle};
  if (votes_.size() < 6) return fit;
  // Least squares over what lies near the median's line; on closed lines votes beyond the seam are a length away.
  double n = 0, s = 0, u = 0, ss = 0, su = 0;
  for (const Vote& vote : votes_) {
    const double away = vote.u_px - vote.way_px - fit.offset_px;
    if (std::abs(away) > 12 + 0.15 * vote.way_px) continue;
    n += 1, s += vote.way_px, u += vote.u_px, ss += vote.way_px * vote.way_px, su += vote.way_px * vote.u_px;
  }
  const double spread = n * ss - s * s;
  if (n < 4 || spread < n * n * 100) return fit;  // shorter than 10 px says nothing about stretching
  double scale = std::clamp((n * su - s * u) / spread, 0.5, 2.0);
  scale += (1 - scale) * 0.05;
  return {static_cast<float>(scale), static_cast<float>((u - scale * s) / n)};
}

StrokeFit StrokeMemory::fit(const StrokePath& path, float period_px) {
  const std::span<const StrokeSample> samples = path.samples();
  votes_.clear();
  for (std::size_t i = 0; i < samples.size(); i += kEvery) {
    const Place* place = nearest(samples[i].px, way_at(path, i));
    if (place == nullptr) continue;
    const float ahead_px = glm::dot(samples[i].px - place->px, place->way);
    votes_.push_back({samples[i].way_px, place->u_px + place->scale * ahead_px, place->line});
  }
  StrokeFit fit;
  if (keep_most_voted()) fit = fit_votes();
  if (path.closed() && period_px > 0) {
    const float whole = std::max(std::round(fit.scale * path.length_px() / period_px), 1.0f);
    fit.scale = whole * period_px / path.length_px();
  }
  return fit;
}

void StrokeMemory::remember(const StrokePath& path, const StrokeFit& fit) {
  const std::span<const StrokeSample> samples = path.samples();
  for (std::size_t i = 0; i + 1 < samples.size(); i += kEvery) {
    Place place;
    place.here = samples[i].place;
    place.ahead = samples[i + 1].place;
    place.u_px = fit.scale * samples[i].way_px + fit.offset_px;
    place.scale = fit.scale;
    place.line = lines_;
    now_.push_back(place);
  }
  ++lines_;
}

}  // namespace rinkaku::outline
