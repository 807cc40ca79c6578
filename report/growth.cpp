#include "report/growth.h"

#include <cmath>

namespace rinkaku::report {

std::optional<double> growth_exponent(std::span<const glm::dvec2> points) {
  glm::dvec2 mean(0);
  for (const glm::dvec2& p : points) {
    if (!(p.x > 0 && p.y > 0) || !std::isfinite(p.x) || !std::isfinite(p.y)) return std::nullopt;
    mean += glm::dvec2(std::log(p.x), std::log(p.y)) / static_cast<double>(points.size());
  }
  double squares = 0, products = 0;
  for (const glm::dvec2& p : points) {
    const double x = std::log(p.x) - mean.x, y = std::log(p.y) - mean.y;
    squares += x * x, products += x * y;
  }
  // Logarithms of equal values differ from their mean by rounding alone.
  if (squares < 1e-18) return std::nullopt;
  return products / squares;
}

}  // namespace rinkaku::report
