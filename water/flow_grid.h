#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>

#include "water/surface.h"

namespace rinkaku::water {

/// Square cells over a surface with some room around it; what lies outside counts as its rim.
struct FlowGrid {
  glm::dvec2 origin{0};  ///< of cell (0, 0), the surface's metres
  double cell_m = 1, cells_per_m = 1;
  int columns = 1, rows = 1;  ///< cells

  /// At most `cells` along the longer side, and two more on each side around it.
  FlowGrid(const Surface& surface, int cells);

  std::size_t node(int x, int y) const { return static_cast<std::size_t>(y) * (columns + 1) + x; }
  std::size_t nodes() const { return static_cast<std::size_t>(columns + 1) * (rows + 1); }
  glm::dvec2 place(int x, int y) const { return origin + glm::dvec2(x, y) * cell_m; }

  /// The cell that holds a place, and where in it (0 to 1).
  struct Cell {
    int x = 0, y = 0;
    double fx = 0, fy = 0;
  };
  Cell cell_of(glm::dvec2 p) const {
    const double gx = std::clamp((p.x - origin.x) * cells_per_m, 0.0, columns * (1 - 1e-12));
    const double gy = std::clamp((p.y - origin.y) * cells_per_m, 0.0, rows * (1 - 1e-12));
    const int x = static_cast<int>(gx), y = static_cast<int>(gy);
    return {x, y, gx - x, gy - y};
  }

  /// Bilinear between the nodes' values.
  glm::dvec2 between(const std::vector<glm::dvec2>& values, glm::dvec2 p) const {
    const Cell c = cell_of(p);
    const std::size_t n = node(c.x, c.y), up = n + columns + 1;
    return (values[n] * (1 - c.fx) + values[n + 1] * c.fx) * (1 - c.fy) +
           (values[up] * (1 - c.fx) + values[up + 1] * c.fx) * c.fy;
  }
};

}  // namespace rinkaku::water
