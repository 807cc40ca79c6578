#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/rig.h"

namespace rinkaku::mesh {

/// Splits welded points whose vertices move differently, such as closed lips: they meet at rest, but are no one point
/// of the surface. `rig` is per vertex, `point` says each vertex's point and is changed, `count` is how many there are.
/// Weights within half a percent and places within a ten-thousandth of the mesh's size count as equal.
void split_by_movement(const Rig& rig, std::vector<std::uint32_t>& point, std::size_t& count);

/// The rig of the points that `vertices` stand for, each a vertex of `of_vertices`.
Rig rig_of_points(Rig of_vertices, std::span<const std::uint32_t> vertices);

}  // namespace rinkaku::mesh
