#include "outline/far_walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace rinkaku::outline {
namespace {

constexpr std::uint32_t most_in_leaf = 4;
constexpr std::size_t deepest = 64;  // halving 2^32 triangles takes half of it

// Where a ray enters a box, or FarWalls::kNone if it misses it.
float entry(const glm::vec3& min, const glm::vec3& max, const glm::vec3& from, const glm::vec3& inverse) {
  const glm::vec3 a = (min - from) * inverse, b = (max - from) * inverse;
  const glm::vec3 in = glm::min(a, b), out = glm::max(a, b);
  const float enters = std::max(std::max(in.x, in.y), std::max(in.z, 0.0f));
  return enters <= std::min(std::min(out.x, out.y), out.z) ? enters : FarWalls::kNone;
}

}  // namespace

FarWalls::FarWalls(const mesh::Topology& topology) : topology_(topology) {
  walls_.reserve(topology.faces.size());
  for (std::uint32_t f = 0; f < topology.faces.size(); ++f) {
    const glm::uvec3& face = topology.faces[f];
    const glm::vec3 a = topology.points[face[0]];
    Wall wall{a, topology.points[face[1]] - a, topology.points[face[2]] - a, f};
    if (topology.turned[f] != 0) std::swap(wall.edge1, wall.edge2);
    walls_.push_back(wall);
  }
  nodes_.reserve(walls_.size());
  if (!walls_.empty()) build(0, static_cast<std::uint32_t>(walls_.size()));
}

std::uint32_t FarWalls::build(std::uint32_t first, std::uint32_t count) {
  const auto at = static_cast<std::uint32_t>(nodes_.size());
  Node node;
  node.min = glm::vec3(3e38f), node.max = glm::vec3(-3e38f);
  node.first = first, node.count = count;
  for (std::uint32_t i = first; i < first + count; ++i) {
    const Wall& wall = walls_[i];
    for (const glm::vec3& p : {wall.corner, wall.corner + wall.edge1, wall.corner + wall.edge2}) {
      node.min = glm::min(node.min, p), node.max = glm::max(node.max, p);
    }
  }
  // What is flat has a box with room for a ray's rounding.
  const glm::vec3 room = 1e-6f * (glm::max(glm::abs(node.min), glm::abs(node.max)) + (node.max - node.min));
  node.min -= room, node.max += room;
  nodes_.push_back(node);
  if (count <= most_in_leaf) return at;
  const glm::vec3 extent = node.max - node.min;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const auto begin = walls_.begin() + first;
  const auto centre = [axis](const Wall& w) { return 3 * w.corner[axis] + w.edge1[axis] + w.edge2[axis]; };
  std::nth_element(begin, begin + count / 2, begin + count,
                   [&](const Wall& a, const Wall& b) { return centre(a) < centre(b); });
  build(first, count / 2);
  const std::uint32_t right = build(first + count / 2, count - count / 2);
  nodes_[at].right = right;
  return at;
}

float FarWalls::distance(std::uint32_t point, const glm::vec3& direction, std::uint32_t component) const {
  float nearest = kNone;
  if (nodes_.empty()) return nearest;
  const glm::vec3 from = topology_.points[point];
  glm::vec3 inverse;
  for (int k = 0; k < 3; ++k) inverse[k] = 1 / (std::abs(direction[k]) > 1e-20f ? direction[k] : 1e-20f);
  const auto look_at = [&](const Wall& wall) {
    // Möller and Trumbore, "Fast, minimum storage ray/triangle intersection", 1997; only from within.
    const glm::vec3 across = glm::cross(direction, wall.edge2);
    const float volume = glm::dot(wall.edge1, across);
    if (!(volume < 0)) return;
    const glm::vec3 to = from - wall.corner;
    const float u = glm::dot(to, across) / volume;
    if (!(u >= -1e-5f && u <= 1.00001f)) return;  // a little more: no ray slips through between two walls
    const glm::vec3 along = glm::cross(to, wall.edge1);
    const float v = glm::dot(direction, along) / volume;
    if (!(v >= -1e-5f && u + v <= 1.00001f)) return;
    const float way = glm::dot(wall.edge2, along) / volume;
    if (!(way > 0 && way < nearest)) return;
    const glm::uvec3& face = topology_.faces[wall.face];
    if (face[0] == point || face[1] == point || face[2] == point) return;
    if (topology_.component[wall.face] == component) nearest = way;
  };
  std::array<std::uint32_t, deepest> waiting;
  std::size_t count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const std::uint32_t at = waiting[--count];
    const Node& node = nodes_[at];
    if (entry(node.min, node.max, from, inverse) >= nearest) continue;
    if (node.right == 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) look_at(walls_[i]);
      continue;
    }
    const Node &left = nodes_[at + 1], &right = nodes_[node.right];
    const bool left_first = glm::dot(left.min + left.max, direction) <= glm::dot(right.min + right.max, direction);
    waiting[count++] = left_first ? node.right : at + 1;
    waiting[count++] = left_first ? at + 1 : node.right;
  }
  return nearest;
}

}  // namespace rinkaku::outline
