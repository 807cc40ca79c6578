#include "outline/local_thickness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "outline/far_walls.h"
#include "outline/point_neighbours.h"
#include "outline/ring_smoothing.h"

namespace rinkaku::outline {
namespace {

// At a rounded tip rays run along the part, beside it across: averaged less, lines around horns are jagged.
constexpr int kSmoothing = 8;
constexpr float kUnknown = FarWalls::kNone;

// The middle of the rays' lengths; kUnknown if most find no wall.
float thickness_at(const FarWalls& walls, std::uint32_t point, const glm::vec3& inwards, std::uint32_t component) {
  constexpr int around = 6;
  constexpr float degree = std::numbers::pi_v<float> / 180;
  const float cosine = std::cos(20 * degree), sine = std::sin(20 * degree);
  const glm::vec3 away = std::abs(inwards.x) < 0.6f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  const glm::vec3 side = glm::normalize(glm::cross(inwards, away)), other = glm::cross(inwards, side);
  std::array<float, 1 + around> ways;
  ways[0] = walls.distance(point, inwards, component);
  for (int i = 0; i < around; ++i) {
    const float angle = static_cast<float>(i) * 60 * degree;
    const glm::vec3 direction = cosine * inwards + sine * (std::cos(angle) * side + std::sin(angle) * other);
    ways[static_cast<std::size_t>(1 + i)] = walls.distance(point, direction, component);
  }
  std::nth_element(ways.begin(), ways.begin() + around / 2, ways.end());
  return ways[around / 2];
}

// Gives points that know nothing the mean of their neighbours that do, from there on outwards.
void spread(const PointNeighbours& neighbours, std::span<float> thickness) {
  std::vector<std::uint32_t> unknown, left;
  for (std::uint32_t p = 0; p < thickness.size(); ++p) {
    if (thickness[p] == kUnknown) unknown.push_back(p);
  }
  std::vector<float> found;
  for (std::size_t before = thickness.size() + 1; !unknown.empty() && unknown.size() < before;) {
    before = unknown.size();
    found.clear();
    for (const std::uint32_t p : unknown) {
      float sum = 0;
      int known = 0;
      for (const std::uint32_t q : neighbours.at(p)) {
        if (thickness[q] != kUnknown) sum += thickness[q], ++known;
      }
      found.push_back(known > 0 ? sum / static_cast<float>(known) : kUnknown);
    }
    left.clear();
    for (std::size_t i = 0; i < unknown.size(); ++i) {
      thickness[unknown[i]] = found[i];
      if (found[i] == kUnknown) left.push_back(unknown[i]);
    }
    unknown.swap(left);
  }
}

// Points of which no two are neighbours, and all others are beside one: about every third. Of small meshes, all.
std::vector<std::uint32_t> looked_at(const PointNeighbours& neighbours, std::size_t points) {
  constexpr std::size_t few = 10000;
  std::vector<std::uint32_t> chosen;
  std::vector<bool> beside(points, false);
  for (std::uint32_t p = 0; p < points; ++p) {
    if (beside[p]) continue;
    chosen.push_back(p);
    if (points < few) continue;
    for (const std::uint32_t q : neighbours.at(p)) beside[q] = true;
  }
  return chosen;
}

}  // namespace

std::vector<float> local_thickness(const mesh::Topology& topology) {
  std::vector<float> thickness(topology.points.size(), kUnknown);
  if (thickness.empty()) return thickness;
  glm::vec3 min = topology.points[0], max = min;
  std::vector<std::uint32_t> component(thickness.size(), mesh::kNone);
  for (std::size_t f = 0; f < topology.faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) component[topology.faces[f][k]] = topology.component[f];
  }
  for (const glm::vec3& p : topology.points) min = glm::min(min, p), max = glm::max(max, p);
  const FarWalls walls(topology);
  const PointNeighbours neighbours(topology);
  for (const std::uint32_t p : looked_at(neighbours, thickness.size())) {
    const glm::vec3 inwards = -topology.outline_normals[p];
    if (component[p] != mesh::kNone && glm::dot(inwards, inwards) > 0.5f) {
      thickness[p] = thickness_at(walls, p, inwards, component[p]);
    }
  }
  spread(neighbours, thickness);
  const float most = glm::length(max - min);
  for (float& t : thickness) t = std::min(t, most);
  RingSmoothing smoothing(topology, kSmoothing);
  smoothing.everywhere();
  smoothing.smooth(thickness);
  return thickness;
}

}  // namespace rinkaku::outline
