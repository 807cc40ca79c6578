#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace rinkaku::test {

/// A rasteriser as graphics cards have them: vertices snapped to 1/256 pixel, exact edges in integers, the top-left
/// rule, back faces culled. Without depth.
class Raster {
 public:
  /// A square picture with the eye looking at the target.
  Raster(int size_px, const glm::dvec3& eye, const glm::dvec3& target, double fov) : size_px_(size_px), eye_(eye) {
    forward_ = glm::normalize(target - eye);
    const glm::dvec3 any = std::abs(forward_.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    right_ = glm::normalize(glm::cross(forward_, any));
    up_ = glm::cross(right_, forward_);
    focal_px_ = size_px / (2 * std::tan(fov / 2));
  }

  /// Per pixel: 1 if a front face covers its centre. Precondition: all points are in front of the eye.
  std::vector<std::uint8_t> coverage(std::span<const glm::vec3> points, std::span<const std::uint32_t> indices) const {
    std::vector<Snapped> snapped(points.size());
    for (std::size_t p = 0; p < points.size(); ++p) {
      const glm::dvec3 d = glm::dvec3(points[p]) - eye_;
      const double scale = focal_px_ / glm::dot(forward_, d);
      snapped[p].x = std::llround((size_px_ * 0.5 + glm::dot(right_, d) * scale) * 256);
      snapped[p].y = std::llround((size_px_ * 0.5 + glm::dot(up_, d) * scale) * 256);
    }
    std::vector<std::uint8_t> out(static_cast<std::size_t>(size_px_) * static_cast<std::size_t>(size_px_), 0);
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
      fill(snapped[indices[i]], snapped[indices[i + 1]], snapped[indices[i + 2]], out);
    }
    return out;
  }

 private:
  struct Snapped {
    std::int64_t x = 0, y = 0;
  };

  static std::int64_t side(const Snapped& a, const Snapped& b, std::int64_t x, std::int64_t y) {
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
  }
  /// Pixels on an edge belong to one of its two sides only.
  static std::int64_t least(const Snapped& a, const Snapped& b) {
    const bool owns = b.y < a.y || (b.y == a.y && b.x > a.x);
    return owns ? 0 : 1;
  }

  void fill(const Snapped& a, const Snapped& b, const Snapped& c, std::vector<std::uint8_t>& out) const {
    if (side(a, b, c.x, c.y) <= 0) return;
    const auto first = [](std::int64_t lowest) { return std::max<std::int64_t>(0, (lowest - 128) / 256); };
    const auto end = [&](std::int64_t highest) { return std::min<std::int64_t>(size_px_, highest / 256 + 1); };
    for (std::int64_t row = first(std::min({a.y, b.y, c.y})); row < end(std::max({a.y, b.y, c.y})); ++row) {
      for (std::int64_t column = first(std::min({a.x, b.x, c.x})); column < end(std::max({a.x, b.x, c.x})); ++column) {
        const std::int64_t x = column * 256 + 128;
        const std::int64_t y = row * 256 + 128;
        if (side(a, b, x, y) >= least(a, b) && side(b, c, x, y) >= least(b, c) && side(c, a, x, y) >= least(c, a)) {
          out[static_cast<std::size_t>(row * size_px_ + column)] = 1;
        }
      }
    }
  }

  int size_px_;
  glm::dvec3 eye_, forward_, right_, up_;
  double focal_px_;
};

/// How many pixels two pictures differ in.
inline int differing(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i];
  return count;
}

}  // namespace rinkaku::test
