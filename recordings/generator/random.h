#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>

#include <glm/vec2.hpp>

namespace rinkaku::recordings {

/// A well-mixed 32-bit number from a tuple of integers: the generator's only randomness, so that every pixel has its
/// own and results depend on neither the order of work nor the number of threads.
inline std::uint32_t hash(std::initializer_list<std::uint32_t> keys) {
  std::uint32_t h = 0x9e3779b9u;
  for (const std::uint32_t key : keys) {
    h = (h ^ key) * 0x85ebca6bu;
    h ^= h >> 15;
    h *= 0xc2b2ae35u;
    h ^= h >> 13;
  }
  return h;
}

/// Uniform in [0, 1).
inline float uniform(std::initializer_list<std::uint32_t> keys) {
  return static_cast<float>(hash(keys) >> 8) * (1.0f / 16777216.0f);
}

/// Point `index` of the R2 low-discrepancy sequence in [0, 1)^2, shifted by `shift` (modulo 1).
inline glm::vec2 low_discrepancy(int index, glm::vec2 shift) {
  const double x = 0.5 + 0.7548776662466927 * index + shift.x, y = 0.5 + 0.5698402909980532 * index + shift.y;
  return {static_cast<float>(x - std::floor(x)), static_cast<float>(y - std::floor(y))};
}

/// Two independent values of standard deviation 1 from two uniform ones (Box and Muller).
inline glm::vec2 gaussian(glm::vec2 u) {
  const float r = std::sqrt(-2.0f * std::log(1.0f - u.x)), a = 6.2831853f * u.y;
  return {r * std::cos(a), r * std::sin(a)};
}

}  // namespace rinkaku::recordings
