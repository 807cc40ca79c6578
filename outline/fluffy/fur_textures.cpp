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

// What stands at one place of a jittered grid that repeats.
struct Seed {
  glm::vec2 way{0};    // from it to the texel, in cells
  float height = 0;    // chance, 0 to 1
  float turn_rad = 0;  // chance
};

// Calls `with` for the seeds of the 5 x 5 cells about a texel.
template <typename With>
void for_seeds_around(const glm::vec2& texel, int cells, std::uint32_t salt, With with) {
  const glm::vec2 at = texel * (static_cast<float>(cells) / side_px);
  const int x0 = static_cast<int>(std::floor(at.x)), y0 = static_cast<int>(std::floor(at.y));
  for (int y = y0 - 2; y <= y0 + 2; ++y) {
    for (int x = x0 - 2; x <= x0 + 2; ++x) {
      const int cx = (x + cells) % cells, cy = (y + cells) % cells;
      Seed seed;
      const glm::vec2 place(static_cast<float>(x) + chance(cx, cy, salt),
                            static_cast<float>(y) + chance(cx, cy, salt + 1));
      seed.way = at - place;
      seed.height = chance(cx, cy, salt + 2);
      seed.turn_rad = chance(cx, cy, salt + 3) * 2 * std::numbers::pi_v<float>;
      with(seed);
    }
  }
}

// Cones of uneven height: the highest over the texel.
float cones(const glm::vec2& texel, int cells, std::uint32_t salt, float radius, float uneven) {
  float highest = 0;
  for_seeds_around(texel, cells, salt, [&](const Seed& seed) {
    const float height = 1 - uneven * seed.height;
    highest = std::max(highest, height * (1 - glm::length(seed.way) / radius));
  });
  return highest;
}

// Round heaps, each with an arm that winds inwards.
float curls(const glm::vec2& texel, int cells, std::uint32_t salt) {
  constexpr float radius = 0.95f;
  float highest = 0;
  for_seeds_around(texel, cells, salt, [&](const Seed& seed) {
    const float r = glm::length(seed.way) / radius;
    if (r >= 1) return;
    const float angle = std::atan2(seed.way.y, seed.way.x) + seed.turn_rad;
    const float arm = 0.5f + 0.5f * std::cos(angle * (seed.height > 0.5f ? 1.0f : -1.0f) + 9.0f * r);
    highest = std::max(highest, std::sqrt(1 - r * r) * (0.72f + 0.18f * arm + 0.1f * seed.height));
  });
  return highest;
}

float height_of(FurKind kind, const glm::vec2& texel) {
  const int tufts = tufts_across(kind);
  switch (kind) {
    case FurKind::Fur:
      // Hairs stand closer and are highest where their tuft is.
      return 0.62f * cones(texel, tufts, 11, 1.25f, 0.45f) + 0.38f * cones(texel, tufts * 3, 23, 1.1f, 0.5f);
    case FurKind::Wool:
      return 0.9f * curls(texel, tufts, 41) + 0.1f * cones(texel, tufts * 5, 53, 1.2f, 0.6f);
    case FurKind::Down:
      return 0.8f * cones(texel, tufts, 61, 1.2f, 0.6f) + 0.2f * cones(texel, tufts / 4, 71, 1.4f, 0.5f);
  }
  return 0;
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
  constexpr std::size_t count = static_cast<std::size_t>(side_px) * side_px;
  std::vector<float> heights(count);
  for (std::size_t i = 0; i < count; ++i) {
    heights[i] = height_of(kind, {static_cast<float>(i % side_px) + 0.5f, static_cast<float>(i / side_px) + 0.5f});
  }
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
