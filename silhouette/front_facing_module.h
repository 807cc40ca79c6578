#pragma once

#include <algorithm>

#include <OpenMesh/Tools/Decimater/ModBaseT.hh>

#include "silhouette/classify.h"
#include "silhouette/collapse_mesh.h"
#include "silhouette/eye_hull.h"

namespace rinkaku::silhouette {

/// The decimater's rule that keeps coverage: every triangle that a collapse makes faces all hull vertices of the view
/// region, and none looks flatter than kFlattest. Gives collapses with well-shaped triangles the lower cost.
template <typename MeshT>
class FrontFacingModule : public OpenMesh::Decimater::ModBaseT<MeshT> {
 public:
  DECIMATING_MODULE(FrontFacingModule, MeshT, FrontFacing);

  explicit FrontFacingModule(MeshT& mesh) : Base(mesh, false) {}

  /// The hull to face; kept by reference.
  void set_hull(const EyeHull* hull) { hull_ = hull; }

  /// From 0 (equilateral) to 1 by the flattest new triangle, or ILLEGAL_COLLAPSE.
  float collapse_priority(const CollapseInfo& collapse) override {
    const MeshT& mesh = Base::mesh();
    const glm::dvec3 target = place_of(mesh, collapse.v1);
    // Faces from v0v1 round to the one right of it; the first and the last vanish.
    double flattest_sq = 1;
    auto spoke = mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(collapse.v0v1));
    glm::dvec3 a = place_of(mesh, mesh.to_vertex_handle(spoke));
    for (;;) {
      const auto next = mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(spoke));
      if (next == collapse.v0v1) break;
      const glm::dvec3 b = place_of(mesh, mesh.to_vertex_handle(next));
      const glm::dvec3 ab = b - a;
      const glm::dvec3 at = target - a;
      const glm::dvec3 bt = target - b;
      const glm::dvec3 normal = glm::cross(ab, at);
      const double longest_sq = std::max({glm::dot(ab, ab), glm::dot(at, at), glm::dot(bt, bt)});
      if (!hull_->sees_front(a, normal, longest_sq)) return float(Base::ILLEGAL_COLLAPSE);
      flattest_sq = std::min(flattest_sq, glm::dot(normal, normal) / (longest_sq * longest_sq));
      spoke = next;
      a = b;
    }
    return static_cast<float>(1 - flattest_sq);
  }

 private:
  const EyeHull* hull_ = nullptr;
};

}  // namespace rinkaku::silhouette
