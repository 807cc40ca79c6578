#include "outline/strokes/radial_curvature.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace rinkaku::outline {
namespace {

constexpr int kRounds = 3;  // of averaging

struct Frame {
  glm::dvec3 u, v;
};

Frame tangents(const glm::dvec3& n) {
  const glm::dvec3 other = std::abs(n.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 across = glm::cross(n, other);
  const double length = glm::length(across);
  if (!(length > 0)) return {glm::dvec3(0), glm::dvec3(0)};
  const glm::dvec3 u = across / length;
  return {u, glm::cross(n, u)};
}

}  // namespace

RadialCurvature::RadialCurvature(const mesh::Topology& topology)
    : around_(topology, kRounds),
      normals_(topology.points.size()),
      forms_(topology.points.size()),
      means_(topology.points.size()) {
  around_.look_everywhere();
  fit(topology.points, topology.outline_normals);
}

void RadialCurvature::move(std::span<const glm::vec3> points, std::span<const glm::vec3> normals,
                           std::span<const std::uint32_t> wanted) {
  around_.look_around(wanted);
  fit(points, normals);
}

void RadialCurvature::fit(std::span<const glm::vec3> points, std::span<const glm::vec3> normals) {
  for (const std::uint32_t p : around_.within(kRounds)) {
    normals_[p] = normals[p];
    forms_[p] = fitted(points, normals[p], p);
  }
  for (int round = kRounds; round-- > 0;) {
    const std::span<const std::uint32_t> inner = around_.within(round);
    for (const std::uint32_t p : inner) {
      const std::span<const std::uint32_t> neighbours = around_.neighbours().at(p);
      glm::mat3 sum = forms_[p];
      for (const std::uint32_t q : neighbours) sum += forms_[q];
      means_[p] = sum / static_cast<float>(neighbours.size() + 1);
    }
    for (const std::uint32_t p : inner) forms_[p] = means_[p];
  }
}

glm::mat3 RadialCurvature::fitted(std::span<const glm::vec3> points, const glm::vec3& normal,
                                  std::uint32_t point) const {
  // Normal equations for the form's three numbers along u and v: of (u u, 2 u v, v v).
  const glm::dvec3 n(normal), at(points[point]);
  const auto [u, v] = tangents(n);
  glm::dmat3 left(0);
  glm::dvec3 right(0);
  for (const std::uint32_t q : around_.neighbours().at(point)) {
    const glm::dvec3 way = glm::dvec3(points[q]) - at;
    const double squared = glm::dot(way, way);
    const double a = glm::dot(way, u), b = glm::dot(way, v), flat = a * a + b * b;
    if (!(flat > 1e-12 * squared)) continue;
    const glm::dvec3 row(a * a / flat, 2 * a * b / flat, b * b / flat);
    left += glm::outerProduct(row, row);
    right += row * (-2 * glm::dot(n, way) / squared);
  }
  // A little towards a ball's, where the neighbours don't say everything.
  const double known = left[0][0] + left[2][2], mean = known > 0 ? (right.x + right.z) / known : 0;
  const double weight = 0.05;
  for (int k = 0; k < 3; ++k) left[k][k] += weight;
  const glm::dvec3 found = glm::inverse(left) * (right + weight * glm::dvec3(mean, 0, mean));
  return glm::mat3(found.x * glm::outerProduct(u, u) + found.y * (glm::outerProduct(u, v) + glm::outerProduct(v, u)) +
                   found.z * glm::outerProduct(v, v));
}

float RadialCurvature::at(std::uint32_t point, const glm::vec3& to_eye) const {
  const glm::vec3& n = normals_[point];
  const glm::vec3 along = to_eye - n * glm::dot(n, to_eye);
  const float squared = glm::dot(along, along);
  return squared > 0 ? glm::dot(along, forms_[point] * along) / squared : 0;
}

}  // namespace rinkaku::outline
