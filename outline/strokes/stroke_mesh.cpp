#include "outline/strokes/stroke_mesh.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace rinkaku::outline {
namespace {

float lattice(int x, int y, int z, std::uint32_t draft) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x8da6b343u ^ static_cast<std::uint32_t>(y) * 0xd8163841u ^
                    static_cast<std::uint32_t>(z) * 0xcb1ab31fu ^ draft * 0x9e3779b9u;
  h ^= h >> 16, h *= 0x7feb352du, h ^= h >> 15, h *= 0x846ca68bu, h ^= h >> 16;
  return static_cast<float>(h) * (2.0f / 4294967295.0f) - 1.0f;
}

}  // namespace

float smooth_noise(const glm::vec3& place, std::uint32_t draft) {
  const glm::vec3 low = glm::clamp(glm::floor(place), -1e9f, 1e9f);
  const glm::vec3 t = glm::clamp(place - low, 0.0f, 1.0f), s = t * t * (3.0f - 2.0f * t);
  const glm::ivec3 c(low);
  float sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
    const float weight = (x != 0 ? s.x : 1 - s.x) * (y != 0 ? s.y : 1 - s.y) * (z != 0 ? s.z : 1 - s.z);
    sum += weight * lattice(c.x + x, c.y + y, c.z + z, draft);
  }
  return sum;
}

void StrokeMesh::clear() {
  vertices_.clear();
  indices_.clear();
}

void StrokeMesh::add(const StrokePath& path, const StrokeFit& fit, const StrokeBand& band) {
  constexpr float margin_px = 0.75f;  // for the smooth edge
  constexpr float endless_px = 1e6f;
  const float out = band.mirrored ? 1.0f : -1.0f;
  const auto first = static_cast<std::uint32_t>(vertices_.size());
  const float length = path.length_px();
  for (const StrokeSample& s : path.samples()) {
    float width = std::max(s.width_px, 1.0f);
    float sway = 0;
    if (band.wobble > 0) {
      const glm::vec3 place = (band.rest != nullptr ? s.place.on(*band.rest) : s.position) / band.wave;
      // Two sizes of waves: the larger one is the hand's, the smaller the pen's.
      const float hand = smooth_noise(place, 2 * band.draft), pen = smooth_noise(3.1f * place, 2 * band.draft + 1);
      const float thicker = std::clamp(1 + band.wobble * (1.2f * hand + 0.6f * pen), 0.15f, 3.0f);
      width *= thicker;
      sway = band.wobble * width * 0.5f * pen;
    }
    // Outside, from a pixel within the contour, where the body's soft edge lies over it.
    const float half = 0.5f * (band.outside ? width + 1 : width);
    const float aside = band.outside ? half - 1 : sway;
    StrokeVertex v;
    v.position = s.position;
    v.half_px = half;
    v.strength = std::min(s.width_px, 1.0f);
    v.to_end_px = path.closed() ? endless_px : std::min(s.way_px, length - s.way_px);
    for (const float side : {-1.0f, 1.0f}) {
      const float across = side * (half + margin_px);
      v.push_px = s.shift_px + s.normal * out * (aside + across);
      v.along_px = {fit.scale * s.way_px + fit.offset_px, across};
      vertices_.push_back(v);
    }
  }
  const auto count = static_cast<std::uint32_t>(path.samples().size());
  for (std::uint32_t i = 0; i + 1 < count; ++i) {
    const std::uint32_t at = first + 2 * i;
    for (const std::uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u}) indices_.push_back(at + corner);
  }
}

}  // namespace rinkaku::outline
