#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "water/stroke_size.h"
#include "water/surface.h"

namespace rinkaku::water {

/// A surface cut into squares (a quadtree) that each need a handful of strokes: where more are wanted, they are
/// smaller.
class Plots {
 public:
  struct Plot {
    glm::dvec2 least{0};
    double side_m = 0;
    double wanted = 0;  ///< strokes, fractions included
    int strokes = 0;    ///< the same in whole ones: rounded up or down so that the sum is right
  };

  /// `strokes`: over the whole surface. Cost: some 20 ms.
  Plots(const Surface& surface, const StrokeDensity& density, int strokes);

  std::span<const Plot> plots() const { return plots_; }
  /// Which plot a place lies in; -1 outside and where no strokes are wanted.
  int find(glm::dvec2 p) const;
  /// Strokes wanted a square metre.
  double per_m2(glm::dvec2 p) const;

 private:
  void divide(int level, int x, int y, std::span<const std::vector<float>> wanted, double& carry);

  glm::dvec2 least_{0};
  double step_m_ = 1;
  std::vector<Plot> plots_;
  std::vector<std::int32_t> plot_of_step_;
  std::vector<float> per_m2_;
};

}  // namespace rinkaku::water
