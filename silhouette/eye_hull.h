#pragma once

#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "silhouette/classify.h"
#include "silhouette/view_regions.h"

namespace rinkaku::silhouette {

/// A region's hull, ready to be asked whether triangles face all of it.
class EyeHull {
 public:
  void set(const ViewRegion& region) {
    vertices_.clear();
    glm::dvec3 sum(0);
    for (const glm::dvec4& h : region.hull) {
      sum += glm::normalize(glm::dvec3(h));
      vertices_.push_back({glm::dvec3(h), h.w, kFlattest * (glm::length(glm::dvec3(h)) + h.w)});
    }
    middle_ = glm::length(sum) > 0 ? glm::normalize(sum) : glm::dvec3(0, 0, 1);
  }

  /// Roughly where the eyes are: a unit vector.
  const glm::dvec3& middle() const { return middle_; }

  /// Whether a triangle with a corner there (inside the unit sphere), the cross product `normal` of two edges and the
  /// longest edge's square faces every hull vertex, and looks no flatter than kFlattest.
  bool sees_front(const glm::dvec3& corner, const glm::dvec3& normal, double longest_sq) const {
    const double offset = glm::dot(normal, corner);
    for (const Vertex& v : vertices_) {
      const double height = glm::dot(normal, v.place) - v.w * offset;
      if (height <= 0) return false;
      if (height >= v.enough * longest_sq) continue;  // enough at the longest possible distance
      const glm::dvec3 way = v.place - v.w * corner;
      const double enough = kFlattest * longest_sq;
      if (height * height < enough * enough * glm::dot(way, way)) return false;
    }
    return true;
  }

 private:
  struct Vertex {
    glm::dvec3 place;
    double w;
    double enough;
  };
  std::vector<Vertex> vertices_;
  glm::dvec3 middle_{0, 0, 1};
};

}  // namespace rinkaku::silhouette
