#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <OpenMesh/Tools/Decimater/ModBaseT.hh>

#include "silhouette/collapse_mesh.h"
#include "silhouette/fan_distance.h"

namespace rinkaku::silhouette {

/// The decimater's rule that bounds how far the collapsed surface lies from the surface it began as. Each face carries
/// a bound; a collapse adds the distance between the fans before and after it to the largest bound of the faces it
/// replaces. So the sum over a chain of collapses is bounded, at every point and not only at vertices.
template <typename MeshT>
class DepthModule : public OpenMesh::Decimater::ModBaseT<MeshT> {
 public:
  DECIMATING_MODULE(DepthModule, MeshT, Depth);

  explicit DepthModule(MeshT& mesh) : Base(mesh, true) {}

  /// Begins with a new mesh. A distance of infinity allows everything.
  void start(double distance) {
    distance_ = distance;
    if (bounded()) bound_.assign(Base::mesh().n_faces(), 0.0);
  }

  float collapse_priority(const CollapseInfo& collapse) override {
    if (!bounded()) return float(Base::LEGAL_COLLAPSE);
    return bound_after(collapse) <= distance_ ? float(Base::LEGAL_COLLAPSE) : float(Base::ILLEGAL_COLLAPSE);
  }

  void preprocess_collapse(const CollapseInfo& collapse) override {
    if (!bounded()) return;
    const double bound = bound_after(collapse);
    const MeshT& mesh = Base::mesh();
    auto spoke = collapse.v0v1;
    do {
      bound_[mesh.face_handle(spoke).idx()] = bound;
      spoke = mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(spoke));
    } while (spoke != collapse.v0v1);
  }

 private:
  bool bounded() const { return std::isfinite(distance_); }

  double bound_after(const CollapseInfo& collapse) {
    const MeshT& mesh = Base::mesh();
    ring_.clear();
    double before = 0;
    auto spoke = collapse.v0v1;
    do {
      ring_.push_back(place_of(mesh, mesh.to_vertex_handle(spoke)));
      before = std::max(before, bound_[mesh.face_handle(spoke).idx()]);
      spoke = mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(spoke));
    } while (spoke != collapse.v0v1);
    return before + fan_distance(place_of(mesh, collapse.v0), ring_);
  }

  double distance_ = 0;
  std::vector<double> bound_;  // per face
  std::vector<glm::dvec3> ring_;
};

}  // namespace rinkaku::silhouette
