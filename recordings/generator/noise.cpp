#include "recordings/generator/noise.h"

#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "recordings/generator/random.h"

namespace rinkaku::recordings {
namespace {

float gradient_dot(glm::ivec3 cell, glm::vec3 offset, unsigned seed) {
  const std::uint32_t h = hash({static_cast<std::uint32_t>(cell.x), static_cast<std::uint32_t>(cell.y),
                                static_cast<std::uint32_t>(cell.z), seed});
  const glm::vec3 gradient(static_cast<float>(h & 1023u) / 511.5f - 1.0f,
                           static_cast<float>((h >> 10) & 1023u) / 511.5f - 1.0f,
                           static_cast<float>((h >> 20) & 1023u) / 511.5f - 1.0f);
  return glm::dot(gradient, offset);
}

}  // namespace

float noise(glm::vec3 p, unsigned seed) {
  const glm::vec3 base = glm::floor(p);
  const glm::vec3 f = p - base;
  const glm::ivec3 cell(base);
  const glm::vec3 w = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
  float corner[8];
  for (int i = 0; i < 8; ++i) {
    const glm::ivec3 c(i & 1, (i >> 1) & 1, i >> 2);
    corner[i] = gradient_dot(cell + c, f - glm::vec3(c), seed);
  }
  const auto mix = [](float a, float b, float t) { return a + (b - a) * t; };
  const float near = mix(mix(corner[0], corner[1], w.x), mix(corner[2], corner[3], w.x), w.y);
  const float far = mix(mix(corner[4], corner[5], w.x), mix(corner[6], corner[7], w.x), w.y);
  return 1.4f * mix(near, far, w.z);
}

float fractal_noise(glm::vec3 p, int octaves, unsigned seed) {
  float sum = 0, weight = 1, total = 0;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * noise(p, seed + static_cast<unsigned>(i));
    total += weight;
    weight *= 0.5f;
    p = p * 2.03f + glm::vec3(17.1f, 5.7f, 11.3f);
  }
  return sum / total * 1.3f;
}

}  // namespace rinkaku::recordings
