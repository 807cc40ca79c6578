#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace rinkaku::mesh {

/// Cuts a polygon into corner count - 2 triangles by ear clipping (Meisters 1975) in its mean plane, and appends them,
/// as indices of corners, wound as the polygon is. Concave polygons come out right; of self-crossing ones it makes the
/// best. Polygons of more than 1,000 corners are cut into a fan. Precondition: three corners or more.
void triangulate(std::span<const glm::vec3> corners, std::vector<glm::uvec3>& triangles);

}  // namespace rinkaku::mesh
