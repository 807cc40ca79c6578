#pragma once

#include <cstdint>

namespace rinkaku::water {

/// A number from 0 to 1 (exclusive) that looks random but depends on the two numbers alone: the same in every run.
inline double scattered(std::uint64_t what, std::uint64_t purpose) {
  std::uint64_t h = what * 0x9E3779B97F4A7C15ull + purpose * 0xD1B54A32D192ED03ull + 0x8CB92BA72F3D8DD7ull;
  h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9ull;
  h = (h ^ (h >> 27)) * 0x94D049BB133111EBull;
  return static_cast<double>((h ^ (h >> 31)) >> 11) * 0x1.0p-53;
}

}  // namespace rinkaku::water
