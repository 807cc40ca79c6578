#include "silhouette/classify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace rinkaku::silhouette {
namespace {

/// Triangles at a time, so that what is kept of each between hull vertices stays in the first cache.
constexpr std::size_t kBlock = 512;

}  // namespace

TrianglePlanes triangle_planes(const Surface& surface) {
  TrianglePlanes out;
  const std::size_t count = surface.triangles.size();
  for (auto* values : {&out.x, &out.y, &out.z, &out.d}) values->resize(count);
  out.corner.resize(count);
  for (std::size_t t = 0; t < count; ++t) {
    const glm::uvec3& v = surface.triangles[t];
    const glm::dvec3 a = surface.frame.to_unit(surface.points[v.x]);
    const glm::dvec3 b = surface.frame.to_unit(surface.points[v.y]);
    const glm::dvec3 c = surface.frame.to_unit(surface.points[v.z]);
    const glm::dvec3 cross = glm::cross(b - a, c - a);
    const double longest_sq = std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)});
    const glm::dvec3 normal = longest_sq > 0 ? cross / longest_sq : glm::dvec3(0);
    out.x[t] = normal.x;
    out.y[t] = normal.y;
    out.z[t] = normal.z;
    out.d[t] = -glm::dot(normal, a);
    out.corner[t] = a;
  }
  return out;
}

void classify(const TrianglePlanes& planes, const ViewRegion& region, std::vector<Side>& out) {
  const std::size_t count = planes.x.size();
  out.resize(count);
  std::array<double, kBlock> least;  // over hull vertices: how flat the triangle looks, squared, the side's sign kept
  std::array<double, kBlock> most;
  for (std::size_t first = 0; first < count; first += kBlock) {
    const std::size_t size = std::min(kBlock, count - first);
    least.fill(std::numeric_limits<double>::infinity());
    most.fill(-std::numeric_limits<double>::infinity());
    for (const glm::dvec4& h : region.hull) {
      for (std::size_t i = 0; i < size; ++i) {
        const std::size_t t = first + i;
        const double height = planes.x[t] * h.x + planes.y[t] * h.y + planes.z[t] * h.z + planes.d[t] * h.w;
        const glm::dvec3& corner = planes.corner[t];
        const double dx = h.x - h.w * corner.x;
        const double dy = h.y - h.w * corner.y;
        const double dz = h.z - h.w * corner.z;
        const double flat_sq = height * std::abs(height) / (dx * dx + dy * dy + dz * dz);
        least[i] = std::min(least[i], flat_sq);
        most[i] = std::max(most[i], flat_sq);
      }
    }
    for (std::size_t i = 0; i < size; ++i) {
      const bool front = least[i] >= kFlattest * kFlattest;
      const bool back = most[i] <= -kFlattest * kFlattest;
      out[first + i] = front ? Side::Front : back ? Side::Back : Side::Silhouette;
    }
  }
}

}  // namespace rinkaku::silhouette
