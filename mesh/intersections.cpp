#include "mesh/intersections.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include "mesh/triangle_pairs.h"

namespace rinkaku::mesh {
namespace {

struct Triangle {
  explicit Triangle(const Topology& topology, std::uint32_t face) : points(topology.faces[face]) {
    for (int k = 0; k < 3; ++k) corners[k] = topology.points[points[k]];
    const glm::dvec3 cross = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double length = glm::length(cross);
    if (length > 0) normal = cross / length;
  }
  bool has_area() const { return normal != glm::dvec3(0); }

  glm::uvec3 points;
  std::array<glm::dvec3, 3> corners;
  glm::dvec3 normal{0};
};

// Where an edge of a triangle meets the other's plane.
struct Crossing {
  glm::dvec3 at;
  glm::dvec3 weights;  // of the triangle's own corners
  double along = 0;    // the planes' common line
};

struct Interval {
  Crossing low, high;
};

Crossing cross(const Triangle& triangle, const glm::dvec3& distance, int i, int k, const glm::dvec3& line) {
  // Always from the point of lesser number, so that both faces of an edge come to the very same place.
  if (triangle.points[i] > triangle.points[k]) std::swap(i, k);
  const double t = distance[i] / (distance[i] - distance[k]);
  Crossing crossing{triangle.corners[i] + t * (triangle.corners[k] - triangle.corners[i]), glm::dvec3(0), 0};
  crossing.weights[i] = 1 - t;
  crossing.weights[k] = t;
  crossing.along = glm::dot(crossing.at, line);
  return crossing;
}

// What of the line lies in the triangle, by the signed distances of its corners from the other's plane.
std::optional<Interval> interval(const Triangle& triangle, const glm::dvec3& distance, const glm::dvec3& line) {
  const bool before[] = {distance[0] >= 0, distance[1] >= 0, distance[2] >= 0};
  if (before[0] == before[1] && before[1] == before[2]) return std::nullopt;
  int alone = 0;
  while (before[alone] == before[(alone + 1) % 3] || before[alone] == before[(alone + 2) % 3]) ++alone;
  Interval found{cross(triangle, distance, alone, (alone + 1) % 3, line),
                 cross(triangle, distance, alone, (alone + 2) % 3, line)};
  if (found.low.along > found.high.along) std::swap(found.low, found.high);
  return found;
}

glm::dvec3 distances(const Triangle& from, const Triangle& triangle) {
  const auto distance = [&](int k) { return glm::dot(from.normal, triangle.corners[k] - from.corners[0]); };
  return {distance(0), distance(1), distance(2)};
}

// The weights at a place on the line within an interval of it.
glm::dvec3 weights_at(const Interval& interval, double along) {
  const double length = interval.high.along - interval.low.along;
  const double t = length > 0 ? std::clamp((along - interval.low.along) / length, 0.0, 1.0) : 0.0;
  return (1 - t) * interval.low.weights + t * interval.high.weights;
}

std::optional<Cut> cut(const Topology& topology, const TrianglePair& pair) {
  const std::array<Triangle, 2> faces{Triangle(topology, pair.face0), Triangle(topology, pair.face1)};
  if (!faces[0].has_area() || !faces[1].has_area()) return std::nullopt;
  const glm::dvec3 line = glm::cross(faces[0].normal, faces[1].normal);
  constexpr double least_sine = 1e-6;
  const double sine = glm::length(line);
  if (sine < least_sine) return std::nullopt;
  const std::optional<Interval> of0 = interval(faces[0], distances(faces[1], faces[0]), line / sine);
  if (!of0) return std::nullopt;
  const std::optional<Interval> of1 = interval(faces[1], distances(faces[0], faces[1]), line / sine);
  if (!of1) return std::nullopt;
  const Crossing& low = of0->low.along > of1->low.along ? of0->low : of1->low;
  const Crossing& high = of0->high.along < of1->high.along ? of0->high : of1->high;
  if (low.along >= high.along || glm::vec3(low.at) == glm::vec3(high.at)) return std::nullopt;
  Cut found;
  found.faces = {pair.face0, pair.face1};
  found.ends = {low.at, high.at};
  found.weights = {{{weights_at(*of0, low.along), weights_at(*of0, high.along)},
                    {weights_at(*of1, low.along), weights_at(*of1, high.along)}}};
  return found;
}

}  // namespace

std::vector<Cut> intersections(const Topology& topology) {
  std::vector<Cut> cuts;
  for (const TrianglePair& pair : close_pairs(topology)) {
    if (const std::optional<Cut> found = cut(topology, pair)) cuts.push_back(*found);
  }
  return cuts;
}

}  // namespace rinkaku::mesh
