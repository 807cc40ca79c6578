#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "silhouette/collapse_mesh.h"
#include "silhouette/front_view.h"
#include "silhouette/shadow_beam.h"
#include "silhouette/view_regions.h"

namespace rinkaku::silhouette {

/// Finds triangles that a front mesh covers from every eye of a region, whatever lies in front.
///
/// Take a part of the front mesh that covers one point of the triangle as one eye sees it. How often the part covers a
/// point changes only where a ray from an eye through the triangle meets the part's boundary. So if no boundary edge
/// lies in the beam of all such rays, it covers all of the triangle from every eye. The part begins with one front
/// triangle and grows over every edge that the beam may touch, until there is none, or the front mesh itself ends.
class HiddenFinder {
 public:
  /// Begins with a region and its collapsed front mesh, which it keeps a reference to.
  void start(const ViewRegion& region, const CollapseMesh& front);

  /// Whether a triangle is covered for certain. Cost: some ten microseconds where the front mesh may cover it, else
  /// under one.
  bool is_hidden(const std::array<glm::dvec3, 3>& triangle);

 private:
  using Face = CollapseMesh::FaceHandle;
  bool covers(Face face);

  const CollapseMesh* front_ = nullptr;
  std::vector<FrontFace> faces_;
  ShadowBeam beam_;
  std::vector<FrontView> views_;  // the first from the middle of the region, the others from its rim
  std::size_t view_count_ = 0;
  std::vector<std::uint32_t> part_mark_;  // per face: the search that took it into its part
  std::uint32_t search_ = 0;
  std::vector<Face> part_;
};

}  // namespace rinkaku::silhouette
