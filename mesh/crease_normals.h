#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace rinkaku::mesh {

/// Shading normals of a triangle list over points: three a face, unit length.
///
/// Faces on both sides of an edge shade smoothly into each other where their normals differ by at most `crease_deg`;
/// all corners at a point that are connected in this way share one normal (to the last bit), the mean of their faces'
/// weighted by the angle at the point (Thürmer and Wüthrich 1998). Where windings disagree, the surface still is
/// smooth and each face's normal keeps to its own outer side. Edges of more than two faces join those that are wound
/// consistently. Faces without area shade like their neighbour.
/// Precondition: no triangle has one point twice.
std::vector<glm::vec3> crease_normals(std::span<const glm::vec3> points, std::span<const glm::uvec3> faces,
                                      double crease_deg);

}  // namespace rinkaku::mesh
