#include "outline/feature_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace rinkaku::outline {

double angle_sum(const glm::vec3& p1, const glm::vec3& n1, const glm::vec3& p2, const glm::vec3& n2) {
  const glm::dvec3 edge = glm::dvec3(p2) - glm::dvec3(p1);
  const double length = glm::length(edge);
  if (!(length > 0)) return std::numbers::pi;
  const auto angle = [&](double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); };
  return angle(glm::dot(edge, glm::dvec3(n1)) / length) + angle(-glm::dot(edge, glm::dvec3(n2)) / length);
}

FeaturePoints::FeaturePoints(const mesh::Topology& rest, double k95, const FeaturePointOptions& options)
    : options_(options),
      k95_(k95),
      stars_(face_stars(rest)),
      neighbours_(rest),
      kinds_(rest.points.size(), Kind::None),
      normals_(rest.points.size()),
      normal_of_(rest.points.size(), 0) {}

std::span<const FeaturePoints::Kind> FeaturePoints::find(std::span<const glm::vec3> points,
                                                         std::span<const std::uint32_t> wanted) {
  ++call_;
  for (const std::uint32_t p : wanted) kinds_[p] = kind_of(points, p);
  return kinds_;
}

glm::vec3 FeaturePoints::normal_at(std::span<const glm::vec3> points, std::uint32_t p) {
  if (normal_of_[p] == call_) return normals_[p];
  glm::vec3 sum(0);
  for (const std::uint32_t corner : stars_.at(p)) {
    const glm::uvec3& face = stars_.faces[corner / 3];
    const glm::vec3 cross = glm::cross(points[face.y] - points[face.x], points[face.z] - points[face.x]);
    const float length = glm::length(cross);
    if (length > 0) sum += cross / length;
  }
  const float length = glm::length(sum);
  normal_of_[p] = call_;
  normals_[p] = length > 1e-6f ? sum / length : glm::vec3(0);
  return normals_[p];
}

FeaturePoints::Kind FeaturePoints::kind_of(std::span<const glm::vec3> points, std::uint32_t p) {
  const glm::vec3 normal = normal_at(points, p);
  if (normal == glm::vec3(0)) return Kind::None;
  int concave = 0, convex = 0;
  for (const std::uint32_t q : neighbours_.at(p)) {
    const glm::vec3 other = normal_at(points, q);
    if (other == glm::vec3(0)) continue;
    const double sum = angle_sum(points[p], normal, points[q], other);
    if (options_.by == FeaturePointOptions::By::Degrees) {
      concave += options_.concave > glm::degrees(sum) ? 1 : 0;
      convex += options_.convex < glm::degrees(sum) ? 1 : 0;
      continue;
    }
    const double length = glm::distance(glm::dvec3(points[p]), glm::dvec3(points[q]));
    if (!(length > 0) || !(k95_ > 0)) continue;
    const double bend = (sum - std::numbers::pi) / (length * k95_);
    concave += options_.concave > 0 && bend < -options_.concave ? 1 : 0;
    convex += options_.convex > 0 && bend > options_.convex ? 1 : 0;
  }
  if (std::max(concave, convex) <= options_.comparison) return Kind::None;
  return concave > convex ? Kind::Concave : Kind::Convex;
}

}  // namespace rinkaku::outline
