#include "silhouette/shadow_beam.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "silhouette/nearest_in_simplex.h"

namespace rinkaku::silhouette {

void ShadowBeam::set_region(const ViewRegion& region) {
  eyes_.clear();
  far_eyes_.clear();
  for (const glm::dvec4& h : region.hull) {
    if (h.w > 0) {
      eyes_.emplace_back(h);
    } else {
      far_eyes_.push_back(glm::normalize(glm::dvec3(h)));
    }
  }
}

void ShadowBeam::set_triangle(const std::array<glm::dvec3, 3>& triangle) {
  before_.points = eyes_;
  before_.points.insert(before_.points.end(), triangle.begin(), triangle.end());
  before_.directions = far_eyes_;
  behind_.points.assign(triangle.begin(), triangle.end());
  behind_.directions.clear();
  for (const glm::dvec3& eye : eyes_) {
    for (const glm::dvec3& t : triangle) behind_.directions.push_back(glm::normalize(t - eye));
  }
  for (const glm::dvec3& d : far_eyes_) behind_.directions.push_back(-d);
}

glm::dvec3 ShadowBeam::Convex::least(const glm::dvec3& axis) const {
  const auto lower = [&](const glm::dvec3& l, const glm::dvec3& r) { return glm::dot(axis, l) < glm::dot(axis, r); };
  glm::dvec3 out = *std::min_element(points.begin(), points.end(), lower);
  if (!directions.empty()) {
    const auto direction = std::min_element(directions.begin(), directions.end(), lower);
    if (glm::dot(axis, *direction) < 0) out += kFar * *direction;
  }
  return out;
}

/// Looks for a plane between them (Gilbert, Johnson and Keerthi's method). Only a plane that was checked counts.
bool ShadowBeam::apart(const Convex& set, const glm::dvec3& p, const glm::dvec3& q) {
  constexpr int kSteps = 16;
  Simplex simplex;  // of the differences between points of the two
  glm::dvec3 way = set.points.back() - (p + q) * 0.5;
  for (int step = 0; step < kSteps; ++step) {
    const double length_sq = glm::dot(way, way);
    if (length_sq < kClear * kClear) return false;
    const glm::dvec3 far_end = glm::dot(way, p) > glm::dot(way, q) ? p : q;
    const glm::dvec3 nearest = set.least(way) - far_end;
    const double between = glm::dot(way, nearest);
    if (between > 0 && between * between > kClear * kClear * length_sq) return true;
    if (step > 0 && length_sq - between <= 1e-9 * length_sq) return false;  // as near as it gets
    simplex.points[simplex.size++] = nearest;
    way = nearest_in_simplex(simplex);
    if (simplex.size == 4) return false;
  }
  return false;
}

bool ShadowBeam::is_clear_of(const glm::dvec3& p, const glm::dvec3& q) const {
  return apart(before_, p, q) && apart(behind_, p, q);
}

}  // namespace rinkaku::silhouette
