#pragma once

#include <span>

#include <glm/vec3.hpp>

namespace rinkaku::silhouette {

/// How far apart a fan of triangles round `centre` and the one that has the ring's first vertex for its centre instead
/// lie at most, measured along the old fan's mean normal. An upper bound of the distance along either's own normals.
/// Infinity if either fan folds over or is steeper than 60 degrees, seen along that normal.
/// `ring`: the fan's rim, anticlockwise seen from in front, at least 3 vertices.
double fan_distance(const glm::dvec3& centre, std::span<const glm::dvec3> ring);

}  // namespace rinkaku::silhouette
