#pragma once

#include <cstdint>
#include <vector>

#include <OpenMesh/Tools/Decimater/BaseDecimaterT.hh>

#include "silhouette/collapse_mesh.h"
#include "silhouette/depth_module.h"
#include "silhouette/eye_hull.h"
#include "silhouette/front_facing_module.h"

namespace rinkaku::silhouette {

/// Collapses front meshes half-edge by half-edge, as far as the decimater's modules let it.
///
/// It goes over the mesh in passes that leave the neighbours of a collapse alone until the next, so the mesh coarsens
/// evenly, and of a vertex's collapses it takes the one with the best shaped triangles. That reaches as few triangles
/// as a heap of priorities over all vertices does, in a tenth of the time: a vertex is tried again only after
/// something beside it has changed.
class FrontCollapse : public OpenMesh::Decimater::BaseDecimaterT<CollapseMesh> {
 public:
  explicit FrontCollapse(CollapseMesh& mesh);

  /// Precondition: boundary vertices of the mesh are locked. The hull is kept by reference while this runs.
  void run(const EyeHull& hull, double depth_distance);

 private:
  bool collapse_best(CollapseMesh::VertexHandle v);
  bool keeps_topology(const CollapseInfo& info);

  OpenMesh::Decimater::ModHandleT<FrontFacingModule<CollapseMesh>> front_facing_;
  OpenMesh::Decimater::ModHandleT<DepthModule<CollapseMesh>> depth_;
  std::vector<std::uint8_t> touched_;  // per vertex: beside a collapse of this pass
  std::vector<std::uint8_t> stuck_;    // per vertex: nothing changed since no collapse was found
  std::vector<std::uint32_t> waiting_;
  std::vector<std::uint32_t> ring_mark_;  // per vertex: the last ring it was in
  std::uint32_t ring_ = 0;
  struct Candidate {
    float cost;
    CollapseMesh::HalfedgeHandle half_edge;
  };
  std::vector<Candidate> candidates_;
};

}  // namespace rinkaku::silhouette
