#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "mesh/mesh.h"
#include "mesh/topology.h"

namespace rinkaku::silhouette {

inline constexpr std::uint32_t kNone = mesh::kNone;

/// Where view regions live: the mesh's own coordinates moved and scaled so that its bounding sphere is the unit sphere.
struct UnitFrame {
  glm::dvec3 centre{0};
  double radius = 1;
  glm::dvec3 to_unit(const glm::dvec3& mesh_point) const { return (mesh_point - centre) / radius; }
  glm::dvec3 to_mesh(const glm::dvec3& unit_point) const { return unit_point * radius + centre; }
};

/// What was done so that a mesh's matte has no holes; `inspect` tells it.
struct Treatment {
  std::uint32_t single_sided_components = 0;
  std::uint32_t repaired_components = 0;   ///< closed, but their windings disagreed: wound alike now, single-sided
  std::uint32_t turned_triangles = 0;      ///< turned round for that
  std::uint32_t two_sided_components = 0;  ///< open, non-manifold or one-sided: each triangle drawn from both sides
  std::uint32_t two_sided_triangles = 0;
};

/// A mesh as mattes are drawn from it: welded points, and triangles whose front is outside.
///
/// Vertices of every region's lists are these points, so one vertex buffer serves the whole mesh and all regions.
/// A value: it keeps no reference to the mesh.
struct Surface {
  std::vector<glm::vec3> points;        ///< the mesh's own coordinates
  std::vector<glm::uvec3> triangles;    ///< indices of points, in the mesh's order, some turned round (see above)
  std::vector<glm::uvec3> neighbours;   ///< per triangle: beside its edges 0-1, 1-2, 2-0; kNone: none wound alike
  std::vector<std::uint8_t> two_sided;  ///< per triangle: 1 if drawn from both sides
  std::vector<std::uint8_t> drawn_from_behind;  ///< per triangle: 1 if its back shows in colour (also by material)
  UnitFrame frame;
  std::uint64_t hash = 0;  ///< of all that lists depend on; a baked file belongs to the surface with its hash
  Treatment treatment;
};

/// Prepares a mesh for mattes.
/// Preconditions: `topology` is the mesh's. Throws Error (Input) if the mesh has no triangle or no size.
/// Cost: about 0.3 microseconds a triangle.
Surface make_surface(const mesh::Mesh& mesh, const mesh::Topology& topology);

/// The whole surface's index list, to be drawn with back faces culled: every triangle, those drawn from both sides
/// followed by a reversed copy. What region lists are compared with, and what is drawn inside the inner radius.
std::vector<std::uint32_t> full_list(const Surface& surface);

/// How many pixels the radius of the unit frame must take in a picture for region lists to cover what the whole surface
/// covers. Rasterisers snap vertices to a grid (1/256 pixel); where edges are few steps long, triangles turn over,
/// and which pixels folds cover depends on the triangles. Asked for are 32 steps for three edges of four.
/// Precondition: the surface has a triangle. Cost: linear.
double least_radius_px(const Surface& surface);

/// How many pixels a ball's radius takes at its far side, seen from `distance` to its middle.
inline double radius_px(double focal_px, double radius, double distance) {
  return focal_px * radius / (distance + radius);
}

}  // namespace rinkaku::silhouette
