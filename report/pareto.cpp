#include "report/pareto.h"

#include <algorithm>
#include <cmath>

namespace rinkaku::report {

std::vector<std::size_t> pareto_front(std::span<const glm::dvec2> points) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::isfinite(points[i].x) && std::isfinite(points[i].y)) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [points](std::size_t a, std::size_t b) {
    return points[a].x != points[b].x ? points[a].x < points[b].x : points[a].y < points[b].y;
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order) {
    const bool better = front.empty() || points[i].y < points[front.back()].y;
    if (better || points[i] == points[front.back()]) front.push_back(i);
  }
  return front;
}

}  // namespace rinkaku::report
