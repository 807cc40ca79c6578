#include "outline/strokes/bristles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <glm/common.hpp>

#include "outline/strokes/stroke_mesh.h"

namespace rinkaku::outline {

mesh::Texture bristles() {
  mesh::Texture image;
  image.width_px = 512, image.height_px = 64;
  image.rgba.assign(static_cast<std::size_t>(image.width_px) * image.height_px * 4, 0);
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x) {
      // Around a circle, so that the end fits the beginning.
      const float turn = 2 * std::numbers::pi_v<float> * static_cast<float>(x) / static_cast<float>(image.width_px);
      const glm::vec2 ring(std::cos(turn), std::sin(turn));
      const float across = 2 * (static_cast<float>(y) + 0.5f) / static_cast<float>(image.height_px) - 1;
      const float hairs = smooth_noise({0.9f * ring.x, 0.9f * ring.y, 9 * across}, 1);
      const float fine = smooth_noise({2.2f * ring.x, 2.2f * ring.y, 23 * across}, 2);
      const float edge = 0.86f + 0.14f * smooth_noise({7 * ring.x, 7 * ring.y, across > 0 ? 5.0f : 0.0f}, 3);
      const float within = glm::smoothstep(edge, edge - 0.22f, std::abs(across));
      const float ink = glm::smoothstep(-0.75f, -0.15f, 0.6f * hairs + 0.4f * fine - 0.25f * across * across);
      const std::size_t at = (static_cast<std::size_t>(y) * image.width_px + x) * 4;
      image.rgba[at + 3] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(within * ink, 0.0f, 1.0f)));
    }
  }
  return image;
}

}  // namespace rinkaku::outline
