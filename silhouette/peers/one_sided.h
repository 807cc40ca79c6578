#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace rinkaku::silhouette {

/// A triangle list taken apart into triangles that are there one way round only, and one of each reversed pair.
struct Sides {
  std::vector<std::uint32_t> single, paired;
};

inline Sides taken_apart(std::span<const std::uint32_t> indices) {
  struct Keyed {
    std::array<std::uint32_t, 3> corners;  // ascending
    std::size_t first = 0;                 // where the triangle stands in the list
    bool odd = false;                      // whether it runs against the ascending order
    bool operator<(const Keyed& b) const { return corners != b.corners ? corners < b.corners : first < b.first; }
  };
  std::vector<Keyed> keyed;
  keyed.reserve(indices.size() / 3);
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const std::uint32_t x = indices[i], y = indices[i + 1], z = indices[i + 2];
    Keyed k{{x, y, z}, i, (x > y) != ((y > z) != (x > z))};
    std::sort(k.corners.begin(), k.corners.end());
    keyed.push_back(k);
  }
  std::sort(keyed.begin(), keyed.end());
  Sides sides;
  for (std::size_t i = 0; i < keyed.size();) {
    // Of a pair the one that comes first is kept: neighbours are wound alike then, as the mesh has them.
    bool both = false;
    std::size_t end = i;
    for (; end < keyed.size() && keyed[end].corners == keyed[i].corners; ++end) both |= keyed[end].odd != keyed[i].odd;
    auto& list = both ? sides.paired : sides.single;
    for (std::size_t corner = 0; corner < 3; ++corner) list.push_back(indices[keyed[i].first + corner]);
    i = end;
  }
  return sides;
}

/// Reduces both kinds by `reduce(list, target)`, each to its share of `target_triangles`, and puts them together again.
template <class Reduce>
std::vector<std::uint32_t> reduced_sides(std::span<const std::uint32_t> indices, std::size_t target_triangles,
                                         const Reduce& reduce) {
  const Sides sides = taken_apart(indices);
  const std::size_t single = sides.single.size() / 3, paired = sides.paired.size() / 3;
  if (single + paired == 0) return {};
  const double share = std::min(1.0, static_cast<double>(target_triangles) / static_cast<double>(single + 2 * paired));
  const auto target = [share](std::size_t count) {
    return static_cast<std::size_t>(share * static_cast<double>(count));
  };
  std::vector<std::uint32_t> out;
  if (single > 0) out = reduce(sides.single, target(single));
  if (paired > 0) {
    const std::vector<std::uint32_t> once = reduce(sides.paired, target(paired));
    for (std::size_t i = 0; i < once.size(); i += 3) {
      out.insert(out.end(), {once[i], once[i + 1], once[i + 2], once[i], once[i + 2], once[i + 1]});
    }
  }
  return out;
}

}  // namespace rinkaku::silhouette
