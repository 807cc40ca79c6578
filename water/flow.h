#pragma once

#include <optional>
#include <span>
#include <vector>

#include "water/arrows.h"
#include "water/flow_grid.h"
#include "water/stream_function.h"
#include "water/surface.h"

namespace rinkaku::water {

struct FlowOptions {
  enum class Method {
    DivergenceFree,  ///< the flow nearest to the arrows that neither gathers nor crosses a shore
    Arrows           ///< the arrows' weighted mean as it is (Suzuki et al. 2004, 4.2)
  } method = Method::DivergenceFree;
  double alpha_m = 0;  ///< equation 1: how far an arrow reaches; 0: an eighth of the surface's diagonal
  int cells = 48;      ///< of the grid, along the longer side
};

/// How the flow of a surface differs from the arrows that lie in it.
struct Deviation {
  double mean_rad = 0;  ///< of the direction
  double largest_rad = 0;
  std::size_t worst = 0;   ///< which arrow
  double speed_ratio = 1;  ///< mean flow speed over mean arrow speed
};

/// A surface's flow over time. Between key frames the arrows turn (see arrows_at) and the flow is solved anew, so that
/// opposite keys never stall; without key frames it is solved once. One thread at a time.
class Flow {
 public:
  /// `surface` must outlive it. `keys` in order of frames; `bodies` stand in the water.
  Flow(const Surface& surface, std::vector<ArrowKey> keys, const FlowOptions& options,
       std::span<const Segment> bodies = {});

  /// Makes velocity() that of this frame. Cost: nothing if the arrows stand still, else some 2 ms at 48 cells.
  void set_frame(double frame);
  /// Metres a second, in the surface's axes.
  glm::dvec2 velocity(glm::dvec2 p) const {
    return stream_ ? stream_->velocity(p) : still_ ? glm::dvec2(0) : grid_.between(wish_, p);
  }
  /// How many arrows are near, each counting exp(-(d / alpha)^2) of its distance d.
  double crowding(glm::dvec2 p) const;
  /// No arrow moves at any time.
  bool still() const { return still_; }
  const FlowGrid& grid() const { return grid_; }
  /// Of the present frame.
  Deviation deviation() const;
  const std::vector<Arrow>& arrows() const { return arrows_; }

 private:
  const Surface* surface_;
  std::vector<ArrowKey> keys_;
  FlowGrid grid_;
  double alpha_m_;
  bool still_ = true;
  std::optional<StreamFunction> stream_;
  std::optional<double> frame_;
  std::vector<Arrow> arrows_;
  std::vector<glm::dvec2> wish_;   // at the grid's nodes
  std::vector<glm::dvec2> crowd_;  // likewise, in x
};

/// Moves what is at `p` along for some seconds: classical Runge-Kutta steps of fourth order, none longer than half a
/// cell. What would cross a shore stops a little short of it and slides on. `velocity` becomes that at the beginning of
/// the last step.
void carry_along(const Flow& flow, const Surface& surface, double seconds, glm::dvec2& p, glm::dvec2& velocity);

}  // namespace rinkaku::water
