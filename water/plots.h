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
    glm::dvec2 size_m{0};
    double wanted = 0;  ///< strokes, fractions included
    int strokes = 0;    ///< the same in whole ones: rounded up or down so that the sum is right
  };

  /// `strokes`: over the whole surface. Cost: some 20 ms.
  Plots(const Surface& surface, const StrokeDensity& density, int strokes);

  std::span<const Plot> plots() const { return plots_; }
  /// Which plot a place lies in; `none` close to the border and outside it, `unseen` where no stroke would be seen.
  int find(glm::dvec2 p) const;
  static constexpr int none = -1, unseen = -2;
  /// Pieces of the line around all plots, where strokes flow in from where they weren't wanted.
  struct Rim {
    glm::dvec2 at{0};
    glm::dvec2 inwards{0};  ///< as long as the piece, metres
    double per_m2 = 0;      ///< strokes wanted inside
  };
  std::span<const Rim> rim() const { return rim_; }

 private:
  void find_rim(const Surface& surface, const std::vector<float>& wanted);
  struct Box {  // of steps
    int left, top, right, bottom;
  };
  void divide(const Box& box, const std::vector<double>& sums, double& carry);

  glm::dvec2 least_{0};
  double step_m_ = 1;
  std::vector<Plot> plots_;
  std::vector<std::int32_t> plot_of_step_;
  std::vector<Rim> rim_;
};

}  // namespace rinkaku::water
