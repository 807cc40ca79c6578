#include "outline/strokes/radial_curvature.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace rinkaku::outline {
namespace {

struct Frame {
  glm::dvec3 u, v;
};

Frame tangents(const glm::dvec3& n) {
  const glm::dvec3 other = std::abs(n.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(n, other));
  return {u, glm::cross(n, u)};
}

}  // namespace

RadialCurvature::RadialCurvature(const mesh::Topology& topology)
    : normals_(topology.outline_normals), forms_(topology.points.size(), glm::mat3(0)) {
  const std::size_t count = topology.points.size();
  // Normal equations for the form's three numbers along u and v: of (u u, 2 u v, v v).
  std::vector<glm::dmat3> left(count, glm::dmat3(0));
  std::vector<glm::dvec3> right(count, glm::dvec3(0));
  const auto add = [&](std::uint32_t at, std::uint32_t neighbour) {
    const glm::dvec3 n(normals_[at]);
    const glm::dvec3 way = glm::dvec3(topology.points[neighbour]) - glm::dvec3(topology.points[at]);
    const double squared = glm::dot(way, way);
    const auto [u, v] = tangents(n);
    const double a = glm::dot(way, u), b = glm::dot(way, v), flat = a * a + b * b;
    if (!(flat > 1e-12 * squared)) return;
    const glm::dvec3 row(a * a / flat, 2 * a * b / flat, b * b / flat);
    left[at] += glm::outerProduct(row, row);
    right[at] += row * (-2 * glm::dot(n, way) / squared);
  };
  for (const mesh::Edge& edge : topology.edges) {
    add(edge.a, edge.b);
    add(edge.b, edge.a);
  }
  for (std::size_t p = 0; p < count; ++p) {
    // A little towards a ball's, where the neighbours don't say everything.
    const double mean =
        left[p][0][0] + left[p][2][2] > 0 ? (right[p].x + right[p].z) / (left[p][0][0] + left[p][2][2]) : 0;
    const double weight = 0.05;
    glm::dmat3 m = left[p];
    for (int k = 0; k < 3; ++k) m[k][k] += weight;
    const glm::dvec3 found = glm::inverse(m) * (right[p] + weight * glm::dvec3(mean, 0, mean));
    const auto [u, v] = tangents(glm::dvec3(normals_[p]));
    forms_[p] =
        glm::mat3(found.x * glm::outerProduct(u, u) + found.y * (glm::outerProduct(u, v) + glm::outerProduct(v, u)) +
                  found.z * glm::outerProduct(v, v));
  }
  std::vector<glm::mat3> sums;
  std::vector<float> weights;
  for (int round = 0; round < 3; ++round) {
    sums = forms_;
    weights.assign(count, 1.0f);
    for (const mesh::Edge& edge : topology.edges) {
      sums[edge.a] += forms_[edge.b], sums[edge.b] += forms_[edge.a];
      weights[edge.a] += 1, weights[edge.b] += 1;
    }
    for (std::size_t p = 0; p < count; ++p) forms_[p] = sums[p] / weights[p];
  }
}

float RadialCurvature::at(std::uint32_t point, const glm::vec3& to_eye) const {
  const glm::vec3& n = normals_[point];
  const glm::vec3 along = to_eye - n * glm::dot(n, to_eye);
  const float squared = glm::dot(along, along);
  return squared > 0 ? glm::dot(along, forms_[point] * along) / squared : 0;
}

}  // namespace rinkaku::outline
