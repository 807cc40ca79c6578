#include "outline/strokes/stroke_path.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace rinkaku::outline {
namespace {

constexpr float kNear_m = 1e-3f;

StrokeSample between(const StrokeSample& a, const StrokeSample& b, float t) {
  StrokeSample s;
  s.place = {a.place.from, b.place.from, t};
  s.position = glm::mix(a.position, b.position, t);
  // Straight on the screen too, but depth runs with its inverse.
  s.px = glm::mix(a.px, b.px, t);
  s.depth_m = glm::mix(a.depth_m, b.depth_m, t);
  s.width_px = glm::mix(a.width_px, b.width_px, t);
  return s;
}

}  // namespace

void StrokePath::trace(std::span<const std::uint32_t> vertices, std::span<const float> widths_px,
                       const LinePoints& points, const glm::mat4& to_pixels, bool closed, const PathOptions& options) {
  samples_.clear();
  closed_ = closed;
  StrokeSample before;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const std::uint32_t v = vertices[i];
    StrokeSample node;
    node.place = {v, v, 0};
    node.position = points[v];
    const glm::vec3 seen(to_pixels * glm::vec4(node.position, 1));
    if (!(seen.z > kNear_m)) {
      closed_ = false;
      break;
    }
    node.px = glm::vec2(seen) / seen.z;
    node.depth_m = seen.z;
    node.width_px = widths_px[i];
    if (samples_.empty()) {
      samples_.push_back(node);
      before = node;
      continue;
    }
    const float length = glm::length(node.px - before.px);
    const bool last = i + 1 == vertices.size();
    // Over small triangles not every vertex makes a sample.
    if (length < 0.35f * options.step_px && !last) continue;
    const int count = std::clamp(static_cast<int>(std::ceil(length / options.step_px)), 1, 500);
    for (int k = 1; k <= count; ++k) {
      StrokeSample s = k == count ? node : between(before, node, static_cast<float>(k) / static_cast<float>(count));
      s.way_px = samples_.back().way_px + length / static_cast<float>(count);
      samples_.push_back(s);
    }
    before = node;
  }
  if (samples_.size() < 2) {
    samples_.clear();
    return;
  }
  limit_growth(options.most_growth);
  smooth(options);
  find_normals();
  smooth_normals(options.smoothing);
}

void StrokePath::limit_growth(float most_growth) {
  const auto limit = [&](StrokeSample& s, const StrokeSample& beside) {
    s.width_px = std::min(s.width_px, beside.width_px + most_growth * std::abs(s.way_px - beside.way_px));
  };
  // Twice around what is closed.
  for (int round = 0; round < (closed_ ? 2 : 1); ++round) {
    for (std::size_t i = 1; i < samples_.size(); ++i) limit(samples_[i], samples_[i - 1]);
    for (std::size_t i = samples_.size() - 1; i-- > 0;) limit(samples_[i], samples_[i + 1]);
    if (!closed_) continue;
    const float both = std::min(samples_.front().width_px, samples_.back().width_px);
    samples_.front().width_px = samples_.back().width_px = both;
  }
}

void StrokePath::smooth(const PathOptions& options) {
  const std::size_t n = samples_.size();
  if (n < 3) return;
  for (int round = 0; round < options.smoothing; ++round) {
    before_ = samples_;
    for (std::size_t i = 0; i < n; ++i) {
      if (!closed_ && (i == 0 || i + 1 == n)) continue;
      // A closed path has its first sample again at the end.
      const StrokeSample& left = before_[i == 0 ? n - 2 : i - 1];
      const StrokeSample& right = before_[i + 1 == n ? 1 : i + 1];
      const StrokeSample& here = before_[i];
      const glm::vec2 mean =
          0.5f * (here.px + here.shift_px) + 0.25f * (left.px + left.shift_px) + 0.25f * (right.px + right.shift_px);
      glm::vec2 shift = mean - here.px;
      const float length = glm::length(shift);
      if (length > options.most_shift_px) shift *= options.most_shift_px / length;
      samples_[i].shift_px = shift;
      samples_[i].width_px = 0.5f * here.width_px + 0.25f * (left.width_px + right.width_px);
    }
  }
}

void StrokePath::find_normals() {
  constexpr float least_cos = 0.5f;  // sharper bends are cut off
  const std::size_t n = samples_.size();
  const auto place = [&](std::size_t i) { return samples_[i].px + samples_[i].shift_px; };
  const auto unit = [](const glm::vec2& v) {
    const float length = glm::length(v);
    return length > 1e-6f ? v / length : glm::vec2(0);
  };
  for (std::size_t i = 0; i < n; ++i) {
    const bool first = i == 0, last = i + 1 == n;
    const glm::vec2 in =
        first ? (closed_ ? unit(place(0) - place(n - 2)) : glm::vec2(0)) : unit(place(i) - place(i - 1));
    const glm::vec2 out = last ? (closed_ ? unit(place(1) - place(0)) : glm::vec2(0)) : unit(place(i + 1) - place(i));
    const glm::vec2 along = unit(in + out);
    const glm::vec2 one = in == glm::vec2(0) ? out : in;
    const float cosine = std::max(glm::dot(along, one), least_cos);
    samples_[i].normal = glm::vec2(along.y, -along.x) / cosine;
  }
}

void StrokePath::smooth_normals(int rounds) {
  const std::size_t n = samples_.size();
  if (n < 3) return;
  for (int round = 0; round < rounds; ++round) {
    before_ = samples_;
    for (std::size_t i = 0; i < n; ++i) {
      if (!closed_ && (i == 0 || i + 1 == n)) continue;
      const glm::vec2& left = before_[i == 0 ? n - 2 : i - 1].normal;
      const glm::vec2& right = before_[i + 1 == n ? 1 : i + 1].normal;
      samples_[i].normal = 0.5f * before_[i].normal + 0.25f * (left + right);
    }
  }
}

}  // namespace rinkaku::outline
