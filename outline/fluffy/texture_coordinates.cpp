#include "outline/fluffy/texture_coordinates.h"

#include <algorithm>
#include <array>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace rinkaku::fluffy {
namespace {

struct Side {
  std::uint64_t edge;  // its two points, the lower first
  std::uint32_t face;
};

// Pairs of triangles that share an edge.
std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbours(std::span<const glm::uvec3> corners) {
  std::vector<Side> sides;
  sides.reserve(corners.size() * 3);
  for (std::uint32_t f = 0; f < corners.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(corners[f][k], corners[f][(k + 1) % 3]);
      sides.push_back({(std::uint64_t{low} << 32) | high, f});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.edge < b.edge; });
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::size_t i = 1; i < sides.size(); ++i) {
    if (sides[i].edge == sides[i - 1].edge) pairs.emplace_back(sides[i - 1].face, sides[i].face);
  }
  return pairs;
}

}  // namespace

std::vector<std::uint8_t> chart_axes(std::span<const glm::vec3> points, std::span<const glm::uvec3> corners) {
  // Votes are squared parts of the normal; neighbours' are added, so that axes change along smooth lines.
  constexpr int rounds = 3;
  std::vector<glm::vec3> votes(corners.size());
  for (std::size_t f = 0; f < corners.size(); ++f) {
    const glm::uvec3& c = corners[f];
    const glm::vec3 n = glm::cross(points[c.y] - points[c.x], points[c.z] - points[c.x]);
    const float square = glm::dot(n, n);
    if (square > 0) votes[f] = n * n / square;
  }
  const auto pairs = neighbours(corners);
  std::vector<glm::vec3> sums;
  for (int round = 0; round < rounds; ++round) {
    sums = votes;
    for (const auto& [a, b] : pairs) {
      sums[a] += 0.5f * votes[b];
      sums[b] += 0.5f * votes[a];
    }
    for (std::size_t f = 0; f < sums.size(); ++f) {
      const float all = sums[f].x + sums[f].y + sums[f].z;
      votes[f] = all > 0 ? sums[f] / all : sums[f];
    }
  }
  std::vector<std::uint8_t> axes(corners.size());
  for (std::size_t f = 0; f < axes.size(); ++f) {
    const glm::vec3& v = votes[f];
    axes[f] = v.x >= v.y && v.x >= v.z ? 0 : v.y >= v.z ? 1 : 2;
  }
  return axes;
}

glm::vec2 chart_uv(const glm::vec3& point, std::uint8_t axis, double tile_m) {
  const glm::vec2 across = axis == 0   ? glm::vec2(point.y, point.z)
                           : axis == 1 ? glm::vec2(point.z, point.x)
                                       : glm::vec2(point.x, point.y);
  return across / static_cast<float>(tile_m);
}

}  // namespace rinkaku::fluffy
