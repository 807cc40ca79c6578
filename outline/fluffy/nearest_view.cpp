#include "outline/fluffy/nearest_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace rinkaku::fluffy {

NearestView::NearestView(const BandSurface& surface, double sine, std::uint32_t candidates) {
  // The centre of gravity of the frame's corners.
  for (const glm::vec3& p : surface.points) centre_ += glm::dvec3(p);
  centre_ /= static_cast<double>(std::max<std::size_t>(surface.points.size(), 1));
  // Along a spiral that turns by the golden angle, even in height: each direction has the same share of the sphere.
  const double turn = std::numbers::pi * (3 - std::sqrt(5.0));
  first_.push_back(0);
  for (std::uint32_t c = 0; c < candidates; ++c) {
    const double height = 1 - (2.0 * c + 1) / candidates;
    const double across = std::sqrt(1 - height * height);
    const glm::dvec3 way(across * std::cos(turn * c), across * std::sin(turn * c), height);
    directions_.emplace_back(way);
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
      double least = 1, most = -1;
      for (int k = 0; k < 3; ++k) {
        const double facing = glm::dot(glm::dvec3(surface.normals[surface.triangles[t][k]]), way);
        least = std::min(least, facing);
        most = std::max(most, facing);
      }
      if (least <= sine && most >= -sine) triangles_.push_back(t);
    }
    first_.push_back(static_cast<std::uint32_t>(triangles_.size()));
  }
}

std::span<const std::uint32_t> NearestView::list(const glm::dvec3& eye) const {
  const glm::vec3 way(eye - centre_);
  std::size_t nearest = 0;
  float most = -1e30f;
  for (std::size_t c = 0; c < directions_.size(); ++c) {
    const float along = glm::dot(directions_[c], way);
    if (along > most) most = along, nearest = c;
  }
  return std::span(triangles_).subspan(first_[nearest], first_[nearest + 1] - first_[nearest]);
}

std::size_t NearestView::bytes() const {
  return directions_.size() * sizeof(directions_[0]) + first_.size() * sizeof(first_[0]) +
         triangles_.size() * sizeof(triangles_[0]);
}

}  // namespace rinkaku::fluffy
