#pragma once

#include <optional>
#include <span>

#include <glm/vec2.hpp>

namespace rinkaku::report {

/// The exponent n of the law y = c x^n that is nearest to the points: the slope of the straight line fitted by least
/// squares to their logarithms. Empty with fewer than two different x, or where a coordinate is not above 0.
std::optional<double> growth_exponent(std::span<const glm::dvec2> points);

}  // namespace rinkaku::report
