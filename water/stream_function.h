#pragma once

#include <array>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "water/banded_cholesky.h"
#include "water/flow_grid.h"
#include "water/section.h"
#include "water/surface.h"

namespace rinkaku::water {

/// The divergence-free flow nearest to a wished one that crosses no shore.
///
/// The flow is the curl of a stream function, a cubic B-spline on a grid, so its divergence is zero everywhere and not
/// only on average. Its coefficients minimise the integral over the water of (flow - wish)^2 with a heavy weight on the
/// flow across shores; open edges are left free. What is across remains a small part of the speed; who moves things
/// along the flow stops them at shores. The equations depend on the shape alone: they are factorised once, and each new
/// wish costs a solution.
class StreamFunction {
 public:
  /// `bodies`: lines of things in the water, which the flow doesn't cross either.
  StreamFunction(const Surface& surface, const FlowGrid& grid, std::span<const Segment> bodies = {});

  /// `wish`: metres a second at the grid's nodes, taken as bilinear between them. No allocation once warm.
  void fit(const std::vector<glm::dvec2>& wish);

  /// Metres a second; beyond the grid as at its rim. Cost: sixteen coefficients.
  glm::dvec2 velocity(glm::dvec2 p) const;

 private:
  struct Sample {  // where the flow is compared with the wish
    glm::dvec2 at;
    double weight;
  };
  std::size_t unknown(int x, int y) const;
  using Form = std::array<double, 16>;  // linear in the coefficients around a cell
  void add_form(const FlowGrid::Cell& cell, const Form& form, double weight);
  void add_water(const Surface& surface);
  void add_shore(glm::dvec2 a, glm::dvec2 b);
  void add_smoothness();

  FlowGrid grid_;
  bool by_columns_ = false;  // the shorter side's index runs fastest, which keeps the band narrow
  std::vector<Sample> samples_;
  BandedCholesky equations_;
  std::vector<double> solved_;
  std::vector<float> coefficients_;  // row by row, times 1 / cell
};

}  // namespace rinkaku::water
