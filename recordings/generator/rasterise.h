#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/vec3.hpp>

namespace rinkaku::recordings {

/// Calls visit(x, y, inverse_depth, weights) for every pixel centre (integer coordinates) of a width x height picture
/// inside the triangle. Corners are (x_px, y_px, 1 / depth); weights are perspective-correct. Both windings are drawn.
template <class Visit>
void rasterise(const std::array<glm::vec3, 3>& corner, int width, int height, const Visit& visit) {
  const auto& [a, b, c] = corner;
  const float area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  if (area == 0) return;
  const int x0 = std::max(0, static_cast<int>(std::ceil(std::min({a.x, b.x, c.x}))));
  const int y0 = std::max(0, static_cast<int>(std::ceil(std::min({a.y, b.y, c.y}))));
  const int x1 = std::min(width - 1, static_cast<int>(std::floor(std::max({a.x, b.x, c.x}))));
  const int y1 = std::min(height - 1, static_cast<int>(std::floor(std::max({a.y, b.y, c.y}))));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const float px = static_cast<float>(x), py = static_cast<float>(y);
      const float u = ((b.x - px) * (c.y - py) - (c.x - px) * (b.y - py)) / area;
      const float v = ((c.x - px) * (a.y - py) - (a.x - px) * (c.y - py)) / area;
      const float w = 1 - u - v;
      if (u < 0 || v < 0 || w < 0) continue;
      const float inverse_depth = u * a.z + v * b.z + w * c.z;
      visit(x, y, inverse_depth, glm::vec3(u * a.z, v * b.z, w * c.z) / inverse_depth);
    }
  }
}

}  // namespace rinkaku::recordings
