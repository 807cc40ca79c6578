#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace rinkaku::silhouette {

/// Reductions that know nothing of the eye, to compare region meshes with at the same number of triangles.
///
/// `indices`: three points a triangle. Both keep the original points (half-edge collapse), so that the result indexes
/// the same vertex buffer, and stop where they can go no further, which may be above `target_triangles`. A triangle
/// whose reversed copy is in the list too is reduced once and written both ways round.

/// meshoptimizer's meshopt_simplify: quadrics, borders kept in place by weight. About 0.5 microseconds a triangle.
std::vector<std::uint32_t> reduce_with_meshopt(std::span<const glm::vec3> points,
                                               std::span<const std::uint32_t> indices, std::size_t target_triangles);

/// OpenMesh's decimater with its quadric module (Garland and Heckbert, "Surface simplification using quadric error
/// metrics", 1997). Triangles that OpenMesh can't hold, as their edges have too many faces, are left as they are.
/// About 5 microseconds a triangle.
std::vector<std::uint32_t> reduce_with_quadrics(std::span<const glm::vec3> points,
                                                std::span<const std::uint32_t> indices, std::size_t target_triangles);

}  // namespace rinkaku::silhouette
