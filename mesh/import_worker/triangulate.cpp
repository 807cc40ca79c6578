#include "mesh/import_worker/triangulate.h"

#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace rinkaku::mesh {
namespace {

constexpr std::size_t kMostCorners = 1000;  // ear clipping takes the cube of it at worst

/// The corners in a plane in which the polygon runs anticlockwise.
std::vector<glm::dvec2> flattened(std::span<const glm::vec3> corners) {
  glm::dvec3 normal(0);  // Newell
  for (std::size_t i = 0; i < corners.size(); ++i) {
    normal += glm::cross(glm::dvec3(corners[i]), glm::dvec3(corners[(i + 1) % corners.size()]));
  }
  const glm::dvec3 size = glm::abs(normal);
  const int drop = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
  std::vector<glm::dvec2> flat;
  for (const glm::vec3& p : corners) {
    const glm::dvec2 q(p[(drop + 1) % 3], p[(drop + 2) % 3]);
    flat.push_back(normal[drop] < 0 ? glm::dvec2(q.y, q.x) : q);
  }
  return flat;
}

double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool is_ear(const std::vector<glm::dvec2>& flat, const std::vector<std::uint32_t>& left, std::size_t tip) {
  const std::size_t count = left.size();
  const glm::dvec2 a = flat[left[(tip + count - 1) % count]];
  const glm::dvec2 b = flat[left[tip]];
  const glm::dvec2 c = flat[left[(tip + 1) % count]];
  if (turn(a, b, c) <= 0) return false;
  for (const std::uint32_t i : left) {
    const glm::dvec2 p = flat[i];
    if (p == a || p == b || p == c) continue;
    if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
  }
  return true;
}

}  // namespace

void triangulate(std::span<const glm::vec3> corners, std::vector<glm::uvec3>& triangles) {
  const std::size_t count = corners.size();
  if (count == 3 || count > kMostCorners) {
    for (std::uint32_t i = 2; i < count; ++i) triangles.emplace_back(0, i - 1, i);
    return;
  }
  const auto flat = flattened(corners);
  std::vector<std::uint32_t> left(count);
  std::iota(left.begin(), left.end(), 0u);
  while (left.size() > 3) {
    std::size_t tip = 1;  // where nothing is an ear, cut anyway: the polygon crosses itself
    for (std::size_t i = 0; i < left.size(); ++i) {
      const std::size_t candidate = (i + 1) % left.size();
      if (is_ear(flat, left, candidate)) {
        tip = candidate;
        break;
      }
    }
    triangles.emplace_back(left[(tip + left.size() - 1) % left.size()], left[tip], left[(tip + 1) % left.size()]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(tip));
  }
  triangles.emplace_back(left[0], left[1], left[2]);
}

}  // namespace rinkaku::mesh
