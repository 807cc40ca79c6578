#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "silhouette/collapse_mesh.h"

namespace rinkaku::silhouette {

/// A triangle of a front mesh.
struct FrontFace {
  CollapseMesh::FaceHandle face;
  std::array<glm::dvec3, 3> corners;
};

/// A front mesh as one eye sees it, to look up what covers a point.
class FrontView {
 public:
  /// Precondition: the eye, in the unit frame, is outside the unit sphere. Cost: linear in the mesh.
  void set(const glm::dvec3& eye, std::span<const FrontFace> front);

  /// Calls `visit(face)` for each front triangle that covers a point of the unit sphere, until it returns true; returns
  /// whether it did.
  template <typename Visit>
  bool any_over(const glm::dvec3& point, const Visit& visit) const {
    const glm::dvec2 p = project(point);
    const int cell = cell_of(p.y) * kCells + cell_of(p.x);
    for (std::uint32_t i = cell_first_[cell]; i < cell_first_[cell + 1]; ++i) {
      const Placed& placed = placed_[cell_items_[i]];
      if (covers(placed, p) && visit(placed.face)) return true;
    }
    return false;
  }

 private:
  struct Placed {
    CollapseMesh::FaceHandle face;
    std::array<glm::dvec2, 3> corners;
  };
  static constexpr int kCells = 128;

  glm::dvec2 project(const glm::dvec3& p) const;
  int cell_of(double along) const;
  static bool covers(const Placed& placed, const glm::dvec2& p);
  template <typename Visit>
  void for_each_cell(const Placed& placed, const Visit& visit) const;

  glm::dvec3 eye_{0}, forward_{0}, right_{0}, up_{0};
  double edge_ = 1;  // of the unit sphere in the picture
  std::vector<Placed> placed_;
  std::vector<std::uint32_t> cell_first_;  // per cell of a grid over the picture: its run in cell_items_
  std::vector<std::uint32_t> cell_items_;  // indices of placed_
  std::vector<std::uint32_t> next_;
};

}  // namespace rinkaku::silhouette
