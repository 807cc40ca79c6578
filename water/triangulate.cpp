#include "water/triangulate.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include <glm/geometric.hpp>

namespace rinkaku::water {
namespace {

bool inside(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  return cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0;
}

bool visible(std::span<const glm::dvec2> ring, std::span<const std::vector<glm::dvec2>> holes, glm::dvec2 a,
             glm::dvec2 b) {
  const auto blocked = [&](std::span<const glm::dvec2> r) {
    for (std::size_t i = 0; i < r.size(); ++i) {
      if (segments_cross(a, b, r[i], r[(i + 1) % r.size()])) return true;
    }
    return false;
  };
  return !blocked(ring) && std::none_of(holes.begin(), holes.end(), [&](const auto& h) { return blocked(h); });
}

// The ring with a hole's corners spliced in by the shortest bridge that crosses nothing.
void join(std::vector<glm::dvec2>& ring, const std::vector<glm::dvec2>& hole,
          std::span<const std::vector<glm::dvec2>> holes) {
  double best = std::numeric_limits<double>::infinity();
  std::size_t at = 0, from = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    for (std::size_t j = 0; j < hole.size(); ++j) {
      const double d = glm::distance(ring[i], hole[j]);
      if (d >= best || !visible(ring, holes, ring[i], hole[j])) continue;
      best = d, at = i, from = j;
    }
  }
  std::vector<glm::dvec2> spliced(hole.begin() + static_cast<std::ptrdiff_t>(from), hole.end());
  spliced.insert(spliced.end(), hole.begin(), hole.begin() + static_cast<std::ptrdiff_t>(from) + 1);
  spliced.push_back(ring[at]);
  ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(at) + 1, spliced.begin(), spliced.end());
}

}  // namespace

double signed_area(std::span<const glm::dvec2> ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec2 a = ring[i] - ring[0], b = ring[(i + 1) % ring.size()] - ring[0];
    twice += a.x * b.y - a.y * b.x;
  }
  return twice / 2;
}

bool segments_cross(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d) {
  const double c1 = cross(a, b, c), d1 = cross(a, b, d), a1 = cross(c, d, a), b1 = cross(c, d, b);
  return ((c1 > 0 && d1 < 0) || (c1 < 0 && d1 > 0)) && ((a1 > 0 && b1 < 0) || (a1 < 0 && b1 > 0));
}

std::vector<glm::dvec2> triangulate(std::span<const glm::dvec2> outline,
                                    std::span<const std::vector<glm::dvec2>> holes) {
  std::vector<glm::dvec2> ring(outline.begin(), outline.end());
  for (const auto& hole : holes) join(ring, hole, holes);
  std::vector<std::size_t> left(ring.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  std::vector<glm::dvec2> triangles;
  while (left.size() > 2) {
    const std::size_t n = left.size();
    std::size_t ear = n;
    double fattest = -1;
    for (std::size_t i = 0; i < n && ear == n; ++i) {
      const glm::dvec2 a = ring[left[(i + n - 1) % n]], b = ring[left[i]], c = ring[left[(i + 1) % n]];
      if (cross(a, b, c) <= 0) continue;
      bool free = true;
      for (std::size_t j = 0; j < n && free; ++j) {
        const glm::dvec2 p = ring[left[j]];
        if (p != a && p != b && p != c) free = !inside(p, a, b, c);
      }
      if (free) ear = i;
    }
    if (ear == n) {  // only slivers are left: take the one that covers most
      for (std::size_t i = 0; i < n; ++i) {
        const double area = cross(ring[left[(i + n - 1) % n]], ring[left[i]], ring[left[(i + 1) % n]]);
        if (ear == n || area > fattest) ear = i, fattest = area;
      }
    }
    const glm::dvec2 a = ring[left[(ear + n - 1) % n]], b = ring[left[ear]], c = ring[left[(ear + 1) % n]];
    if (cross(a, b, c) > 0) triangles.insert(triangles.end(), {a, b, c});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  return triangles;
}

}  // namespace rinkaku::water
