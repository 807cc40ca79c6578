#include "report/section.h"

#include <algorithm>
#include <utility>

#include "report/pareto.h"

namespace rinkaku::report {

Point timed_point(const Spread& time_ms, double error, std::string label) {
  return {time_ms.median, error, time_ms.low, time_ms.high, std::move(label)};
}

std::string front_names(const Plot& plot) {
  std::vector<glm::dvec2> points;
  std::vector<std::string> of;
  for (const Series& series : plot.series) {
    for (const Point& p : series.points) {
      points.emplace_back(p.x, p.y);
      of.push_back(series.joined || p.label.empty() ? series.name : p.label);
    }
  }
  std::vector<std::string> names;
  for (const std::size_t i : pareto_front(points)) {
    if (std::find(names.begin(), names.end(), of[i]) == names.end()) names.push_back(of[i]);
  }
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  }
  return text;
}

}  // namespace rinkaku::report
