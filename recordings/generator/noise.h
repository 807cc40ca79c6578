#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace rinkaku::recordings {

/// Smooth noise in about [-1, 1], features of size 1, the same everywhere for the same seed.
float noise(glm::vec3 p, unsigned seed);
inline float noise(glm::vec2 p, unsigned seed) { return noise(glm::vec3(p, 0.5f), seed); }

/// `octaves` of noise, each of half the size and half the strength of the one before; about [-1, 1].
float fractal_noise(glm::vec3 p, int octaves, unsigned seed);
inline float fractal_noise(glm::vec2 p, int octaves, unsigned seed) {
  return fractal_noise(glm::vec3(p, 0.5f), octaves, seed);
}

}  // namespace rinkaku::recordings
