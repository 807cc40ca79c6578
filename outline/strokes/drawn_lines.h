#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "mesh/mesh.h"

namespace rinkaku::outline {

/// A place on a mesh, which stays on it however its vertices move.
struct SurfacePlace {
  std::uint32_t triangle = 0;
  float b = 0, c = 0;  ///< weights of the triangle's second and third corner; the first has what is left of 1
};

/// A line on a mesh, from place to place.
using DrawnLine = std::vector<SurfacePlace>;

/// Where a ray from `eye` first meets the mesh, and how far along `direction` that is; empty where it misses. Both
/// sides of triangles count. In the mesh's coordinates, computed in double (Möller and Trumbore, "Fast, minimum storage
/// ray/triangle intersection", 1997). Some 5 ns a triangle.
struct SurfaceHit {
  SurfacePlace place;
  double distance = 0;  ///< in lengths of `direction`
};
std::optional<SurfaceHit> first_hit(const mesh::Mesh& mesh, const glm::dvec3& eye, const glm::dvec3& direction);

/// Lays lines that were drawn on a picture onto the mesh that is seen there (Kalnins et al., "WYSIWYG NPR: drawing
/// strokes directly on 3D models", 2002). `ray` gives the direction in which a pixel looks from `eye`, of any length,
/// in the mesh's coordinates; empty if it looks nowhere. Lines are followed in steps of two pixels, and parted where
/// they leave the mesh or jump to a part of it farther away. Parts of a single place are left out.
std::vector<DrawnLine> lay_onto(const mesh::Mesh& mesh, std::span<const std::vector<glm::dvec2>> lines_px,
                                const glm::dvec3& eye,
                                const std::function<std::optional<glm::dvec3>(const glm::dvec2&)>& ray);

}  // namespace rinkaku::outline
