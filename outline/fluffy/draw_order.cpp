#include "outline/fluffy/draw_order.h"

#include <glm/geometric.hpp>

namespace rinkaku::fluffy {

DrawOrder::DrawOrder(const Frame& frame, std::uint32_t layers) : layers_(layers), triangles_(frame.triangles) {
  const std::size_t count = triangles_.size();
  middles_.resize(count);
  normals_.resize(count);
  distances_.reserve(count);
  order_.reserve(count);
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

std::span<const std::uint32_t> DrawOrder::sorted(std::span<const std::uint32_t> triangles, const glm::dvec3& eye,
                                                 std::uint32_t step) {
  const glm::vec3 from(eye);
  distances_.clear();
  for (const std::uint32_t t : triangles) distances_.push_back(glm::length(middles_[t] - from));
  const std::uint32_t lowest = (layers_ - 1) % step;
  std::uint32_t* out = indices_.data();
  for (const std::uint32_t place : order_.farthest_first(distances_)) {
    const std::uint32_t t = triangles[place];
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
