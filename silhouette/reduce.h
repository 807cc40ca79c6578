#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <glm/vec3.hpp>

#include "silhouette/surface.h"
#include "silhouette/view_regions.h"

namespace rinkaku::silhouette {

struct ReduceOptions {
  /// How far the depth product's front mesh may lie from the surface along its normal, in radii; 0: no depth product.
  double depth_distance = 0;
  /// Leave out silhouette triangles that the front mesh hides from every eye of the region (matte only). Doubles the
  /// time.
  bool drop_hidden = false;
};

/// What becomes of a triangle of the surface in a region.
enum class Role : std::uint8_t {
  Dropped,     ///< turns its back on every eye
  Front,       ///< in the front mesh (two-sided ones: whichever winding faces the eyes)
  Silhouette,  ///< untouched
  Hidden,      ///< silhouette, but the front mesh hides it from every eye: the matte doesn't need it
};

/// What is drawn of a surface for eyes in one region. Triangles are of the surface's points.
///
/// Products, each drawn with back faces culled:
///   matte  = Silhouette + matte_front           the same pixels covered as by the whole mesh
///   depth  = Silhouette + Hidden + depth_front  and the depth within `depth_distance` along the normal
///   colour = all that can_show()                the same picture for opaque, culled materials, in the mesh's order
struct RegionMeshes {
  std::vector<Role> roles;              ///< per triangle of the surface
  std::vector<glm::uvec3> matte_front;  ///< front mesh collapsed as far as it goes
  std::vector<glm::uvec3> depth_front;

  std::uint32_t silhouette = 0;    ///< triangles of that role as drawn: two-sided ones count twice
  std::uint32_t hidden = 0;        ///< the same
  std::uint32_t front_before = 0;  ///< triangles of the front mesh before it was collapsed
  /// The fewest triangles any mesh with the front mesh's boundary and topology can have: its boundary edges less twice
  /// its Euler number.
  std::uint32_t front_least = 0;
};

/// The surface's triangles of one role, two-sided ones in both windings.
std::vector<glm::uvec3> triangles_of(const Surface& surface, const RegionMeshes& meshes, Role role);

/// Whether a triangle can show in colour.
inline bool can_show(const Surface& surface, const RegionMeshes& meshes, std::size_t triangle) {
  return meshes.roles[triangle] != Role::Dropped || surface.drawn_from_behind[triangle];
}

/// Reduces a surface for one region after the other, reusing its memory.
///
/// The front mesh (all triangles that face every eye of the region) is collapsed half-edge by half-edge with its
/// boundary fixed, every new triangle facing every hull vertex, none looking flatter than kFlattest; the silhouette
/// mesh stays as it is; the back mesh is dropped. Coverage then can't change: the number of front-facing layers over a
/// pixel is the winding number of the front mesh's boundary. Utsugi et al., "A polygon reduction maintaining
/// silhouettes" (2002), 2.4.
class Reducer {
 public:
  /// Keeps a reference to the surface. Cost: about 0.2 microseconds a triangle.
  explicit Reducer(const Surface& surface);
  ~Reducer();
  Reducer(const Reducer&) = delete;
  Reducer& operator=(const Reducer&) = delete;

  /// Cost: about 0.3 microseconds a triangle of the surface for the matte. The result depends on nothing but the
  /// surface, region and options.
  void reduce(const ViewRegion& region, const ReduceOptions& options, RegionMeshes& out);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rinkaku::silhouette
