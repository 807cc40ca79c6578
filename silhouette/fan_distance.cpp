#include "silhouette/fan_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace rinkaku::silhouette {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLeastCosine = 0.5;

/// Seen along a normal: x and y across it, z along it, from the fan's centre.
struct Across {
  glm::dvec3 x, y, z;
  explicit Across(const glm::dvec3& normal) : z(normal) {
    x = glm::normalize(glm::cross(normal, std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    y = glm::cross(z, x);
  }
  glm::dvec3 operator()(const glm::dvec3& p) const { return {glm::dot(x, p), glm::dot(y, p), glm::dot(z, p)}; }
};

double turn(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.y - a.y * b.x; }

/// Whether a triangle lies within 60 degrees of facing along `normal`.
bool upright(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& normal) {
  const glm::dvec3 cross = glm::cross(b - a, c - a);
  return glm::dot(cross, normal) >= kLeastCosine * glm::length(cross);
}

/// Height of the plane through three points over the origin.
double height_at_origin(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double wa = turn(b, c);
  const double wb = turn(c, a);
  const double wc = turn(a, b);
  return (wa * a.z + wb * b.z + wc * c.z) / (wa + wb + wc);
}

/// How far apart the segment from `hub` to `end` and the one from the origin to `spoke` are where they cross.
double distance_at_crossing(const glm::dvec3& hub, const glm::dvec3& end, const glm::dvec3& spoke) {
  const double side_hub = turn(spoke, hub);
  const double side_end = turn(spoke, end);
  if (side_hub * side_end >= 0) return 0;
  const double s = side_hub / (side_hub - side_end);
  const glm::dvec3 p = hub + s * (end - hub);
  const double t = (p.x * spoke.x + p.y * spoke.y) / (spoke.x * spoke.x + spoke.y * spoke.y);
  if (!(t > 0 && t < 1)) return 0;
  return std::abs(p.z - t * spoke.z);
}

}  // namespace

double fan_distance(const glm::dvec3& centre, std::span<const glm::dvec3> ring) {
  const std::size_t count = ring.size();
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < count; ++i) sum += glm::cross(ring[i] - centre, ring[(i + 1) % count] - centre);
  if (!(glm::length(sum) > 0)) return kInfinity;
  const glm::dvec3 normal = glm::normalize(sum);
  for (std::size_t i = 0; i < count; ++i) {
    if (!upright(centre, ring[i], ring[(i + 1) % count], normal)) return kInfinity;
    if (i > 0 && i + 1 < count && !upright(ring[0], ring[i], ring[i + 1], normal)) return kInfinity;
  }

  // Seen along the normal, both fans are maps of one polygon, and their distance is linear between the old centre, the
  // rim, and the crossings of old and new spokes: largest at one of these.
  const Across across(normal);
  const glm::dvec3 hub = across(ring[0] - centre);
  double largest = 0;
  double deepest_inside = -kInfinity;
  double at_centre = 0;
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const glm::dvec3 a = across(ring[i] - centre);
    const glm::dvec3 b = across(ring[i + 1] - centre);
    const double inside = std::min({turn(hub, a), turn(a, b), turn(b, hub)});
    if (inside > deepest_inside) {
      deepest_inside = inside;
      at_centre = height_at_origin(hub, a, b);
    }
    if (i == 1) continue;  // its spoke is a side of the rim
    for (std::size_t j = 1; j < count; ++j) {
      if (j == i) continue;
      largest = std::max(largest, distance_at_crossing(hub, a, across(ring[j] - centre)));
    }
  }
  return std::max(largest, std::abs(at_centre));
}

}  // namespace rinkaku::silhouette
