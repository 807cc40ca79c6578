#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace rinkaku::report {

/// Which points no other point beats: those for which no other is at most as large in both coordinates and smaller in
/// one. Indices, by rising x. Of equal points all are kept; points that are not finite are left out.
std::vector<std::size_t> pareto_front(std::span<const glm::dvec2> points);

}  // namespace rinkaku::report
