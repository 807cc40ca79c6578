#include "outline/fluffy/fur_textures.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace rinkaku::fluffy {
namespace {

constexpr int side_px = 512;

// A number from 0 to 1 for a place of a grid, the same each time.
float chance(int x, int y, std::uint32_t salt) {
  std::uint32_t h =
      static_cast<std::uint32_t>(x) * 0x9e3779b1u ^ static_cast<std::uint32_t>(y) * 0x85ebca77u ^ salt * 0xc2b2ae3du;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  h ^= h >> 15;
  return static_cast<float>(h) / 4294967296.0f;
}

// What stands in one cell of a jittered grid that repeats.
struct Seed {
  glm::vec2 place{0};  // within the cell, 0 to 1
  float height = 0;    // chance, 0 to 1
  float turn_rad = 0;  // chance
};

class Seeds {
 public:
  Seeds(int cells, std::uint32_t salt) : cells_(cells) {
    for (int y = 0; y < cells; ++y) {
      for (int x = 0; x < cells; ++x) {
        seeds_.push_back({{chance(x, y, salt), chance(x, y, salt + 1)},
                          chance(x, y, salt + 2),
                          chance(x, y, salt + 3) * 2 * std::numbers::pi_v<float>});
      }
    }
  }

  // Calls `with` for the seeds that may be within 1.5 cells of a texel, and the way from each to the texel in cells.
  template <typename With>
  void around(const glm::vec2& texel, With with) const {
    const glm::vec2 at = texel * (static_cast<float>(cells_) / side_px);
    const int x0 = static_cast<int>(std::floor(at.x - 0.5f)), y0 = static_cast<int>(std::floor(at.y - 0.5f));
    for (int y = y0 - 1; y <= y0 + 2; ++y) {
      for (int x = x0 - 1; x <= x0 + 2; ++x) {
        const int cell = ((y + cells_) % cells_) * cells_ + (x + cells_) % cells_;
        const Seed& seed = seeds_[static_cast<std::size_t>(cell)];
        with(seed, at - glm::vec2(x, y) - seed.place);
      }
    }
  }

 private:
  int cells_;
  std::vector<Seed> seeds_;
};

// Cones of uneven height: the highest over the texel. `radius` in cells, to 1.5.
float cones(const glm::vec2& texel, const Seeds& seeds, float radius, float uneven) {
  float highest = 0;
  seeds.around(texel, [&](const Seed& seed, const glm::vec2& way) {
    const float height = 1 - uneven * seed.height;
    highest = std::max(highest, height * (1 - glm::length(way) / radius));
  });
  return highest;
}

// Round heaps, each with an arm that winds inwards.
float curls(const glm::vec2& texel, const Seeds& seeds) {
  constexpr float radius = 0.95f;
  float highest = 0;
  seeds.around(texel, [&](const Seed& seed, const glm::vec2& way) {
    const float r = glm::length(way) / radius;
    if (r >= 1) return;
    const float angle = std::atan2(way.y, way.x) + seed.turn_rad;
    const float arm = 0.5f + 0.5f * std::cos(angle * (seed.height > 0.5f ? 1.0f : -1.0f) + 9.0f * r);
    highest = std::max(highest, std::sqrt(1 - r * r) * (0.72f + 0.18f * arm + 0.1f * seed.height));
  });
  return highest;
}

std::vector<float> heights_of(FurKind kind) {
  const int tufts = tufts_across(kind);
  std::vector<float> heights;
  heights.reserve(static_cast<std::size_t>(side_px) * side_px);
  const auto fill = [&](auto height) {
    for (int y = 0; y < side_px; ++y) {
      for (int x = 0; x < side_px; ++x) heights.push_back(height(glm::vec2(x, y) + 0.5f));
    }
  };
  switch (kind) {
    case FurKind::Fur: {
      // Hairs stand closer than tufts and are highest where their tuft is.
      const Seeds coarse(tufts, 11), fine(tufts * 3, 23);
      fill([&](const glm::vec2& t) {
        return 0.62f * cones(t, coarse, 1.25f, 0.45f) + 0.38f * cones(t, fine, 1.1f, 0.5f);
      });
      break;
    }
    case FurKind::Wool: {
      const Seeds coarse(tufts, 41), fine(tufts * 5, 53);
      fill([&](const glm::vec2& t) { return 0.9f * curls(t, coarse) + 0.1f * cones(t, fine, 1.2f, 0.6f); });
      break;
    }
    case FurKind::Down: {
      const Seeds coarse(tufts / 4, 71), fine(tufts, 61);
      fill([&](const glm::vec2& t) { return 0.2f * cones(t, coarse, 1.4f, 0.5f) + 0.8f * cones(t, fine, 1.2f, 0.6f); });
      break;
    }
  }
  return heights;
}

}  // namespace

int tufts_across(FurKind kind) {
  switch (kind) {
    case FurKind::Fur:
      return 16;
    case FurKind::Wool:
      return 14;
    case FurKind::Down:
      return 40;
  }
  return 1;
}

double tuft_width(FurKind kind) {
  switch (kind) {
    case FurKind::Fur:
      return 0.5;
    case FurKind::Wool:
      return 1.1;
    case FurKind::Down:
      return 0.22;
  }
  return 1;
}

mesh::Texture fur_texture(FurKind kind) {
  const std::vector<float> heights = heights_of(kind);
  const std::size_t count = heights.size();
  // Each texel's rank, so that all heights are equally frequent.
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return heights[a] < heights[b]; });
  mesh::Texture texture;
  texture.width_px = texture.height_px = side_px;
  texture.rgba.resize(count * 4);
  for (std::size_t rank = 0; rank < count; ++rank) {
    std::uint8_t* rgba = texture.rgba.data() + order[rank] * std::size_t{4};
    rgba[0] = rgba[1] = rgba[2] = static_cast<std::uint8_t>(rank * 256 / count);
    rgba[3] = 255;
  }
  return texture;
}

}  // namespace rinkaku::fluffy
