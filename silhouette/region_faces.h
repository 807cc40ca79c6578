#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <glm/vec3.hpp>

#include "mesh/contour.h"
#include "mesh/topology.h"
#include "silhouette/region_lists.h"

namespace rinkaku::silhouette {

/// Tells a mesh::ContourFinder what is known of the eye's region, frame after frame: which faces every eye of it sees
/// from the front or from behind, so that only its silhouette mesh and the edges there are left to look at. What is
/// found is the same.
///
/// What a region's faces are is worked out by RegionLists' thread; until it is there, nothing is known.
class RegionFaces {
 public:
  /// `topology` is of the mesh that the file was baked from. Keeps no reference to it.
  RegionFaces(std::shared_ptr<const RegionFile> file, const mesh::Topology& topology,
              const RegionListsOptions& options = {});

  /// For an eye in the mesh's own coordinates; null if nothing is known. It stays valid until the next call. Costs and
  /// throws as RegionLists::at().
  const mesh::KnownFaces* at(const glm::dvec3& eye_in_mesh);

  /// As RegionLists::wait().
  void wait() { lists_.wait(); }

 private:
  struct EdgeFaces {
    std::uint32_t face0, face1;
  };
  /// What stays the same from region to region.
  struct Base {
    std::vector<EdgeFaces> edges;         ///< the topology's consistent ones
    std::vector<std::uint8_t> uncertain;  ///< per face: 1 if its winding doesn't tell its outer side
  };
  static std::shared_ptr<const Base> base_of(const mesh::Topology& topology);
  static void make(const Base& base, const RegionFile& file, std::uint32_t region, std::vector<std::uint32_t>& out);

  std::size_t faces_;
  RegionLists lists_;
  mesh::KnownFaces known_;
};

}  // namespace rinkaku::silhouette
