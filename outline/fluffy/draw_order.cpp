#include "outline/fluffy/draw_order.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace rinkaku::fluffy {

DrawOrder::DrawOrder(const Frame& frame, std::uint32_t layers) : layers_(layers), triangles_(frame.triangles) {
  const std::size_t count = triangles_.size();
  middles_.resize(count);
  normals_.resize(count);
  entries_.resize(count);
  other_.resize(count);
  indices_.resize(count * layers * 3);
  move(frame);
}

void DrawOrder::move(const Frame& frame) {
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const glm::uvec3& c = frame.corners[t];
    middles_[t] = (frame.points[c.x] + frame.points[c.y] + frame.points[c.z]) / 3.0f;
    normals_[t] = frame.normals[c.x] + frame.normals[c.y] + frame.normals[c.z];
  }
}

// By keys of 16 bits, ascending, equal ones in their order: two rounds of eight bits.
void DrawOrder::sort(std::size_t count) {
  for (auto& round : places_) round.fill(0);
  for (std::size_t i = 0; i < count; ++i) {
    ++places_[0][entries_[i].key & 255];
    ++places_[1][entries_[i].key >> 8];
  }
  for (auto& round : places_) {
    std::uint32_t sum = 0;
    for (std::uint32_t& place : round) {
      const std::uint32_t size = place;
      place = sum;
      sum += size;
    }
  }
  for (std::size_t i = 0; i < count; ++i) other_[places_[0][entries_[i].key & 255]++] = entries_[i];
  for (std::size_t i = 0; i < count; ++i) entries_[places_[1][other_[i].key >> 8]++] = other_[i];
}

std::span<const std::uint32_t> DrawOrder::sorted(std::span<const std::uint32_t> triangles, const glm::dvec3& eye,
                                                 std::uint32_t step) {
  const glm::vec3 from(eye);
  float nearest = 1e30f, farthest = 0;
  for (const std::uint32_t t : triangles) {
    const float distance = glm::length(middles_[t] - from);
    nearest = std::min(nearest, distance);
    farthest = std::max(farthest, distance);
  }
  const float steps = farthest > nearest ? 65535.0f / (farthest - nearest) : 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const float distance = glm::length(middles_[triangles[i]] - from);
    entries_[i] = {static_cast<std::uint32_t>(std::clamp((farthest - distance) * steps, 0.0f, 65535.0f)), triangles[i]};
  }
  sort(triangles.size());

  const std::uint32_t lowest = (layers_ - 1) % step;
  std::uint32_t* out = indices_.data();
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const std::uint32_t t = entries_[i].triangle;
    const bool outwards = glm::dot(normals_[t], from - middles_[t]) >= 0;
    const glm::uvec3 first = triangles_[t] * layers_;
    for (std::uint32_t k = 0; k < layers_; k += step) {
      const std::uint32_t layer = outwards ? lowest + k : layers_ - 1 - k;
      *out++ = first.x + layer;
      *out++ = first.y + layer;
      *out++ = first.z + layer;
    }
  }
  return {indices_.data(), out};
}

}  // namespace rinkaku::fluffy
