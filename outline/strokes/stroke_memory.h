#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "outline/strokes/stroke_path.h"

namespace rinkaku::outline {

/// How far along its stroke a line's place is: u = scale * way + offset, in pixels.
struct StrokeFit {
  float scale = 1, offset_px = 0;
};

/// Keeps strokes where they were in the frame before, as lines move, join and part from frame to frame.
///
/// Places of the last frame's lines are kept on the shape, go with it, are seen anew by this frame's camera, and looked
/// up beside this frame's lines; a straight line is fitted to what those say (after Kalnins, Davidson, Markosian and
/// Finkelstein, "Coherent stylized silhouettes", 2003: votes and fitting, for the line with most votes). What had to be
/// stretched goes back to its own length by and by. No GL. Allocates nothing once warm; about a microsecond a sample.
class StrokeMemory {
 public:
  /// A new frame: sees the last one's places, where `points` have come to be, through `to_pixels` (see
  /// StrokePath::trace).
  void begin(const LinePoints& points, const glm::mat4& to_pixels);
  /// For a line of this frame. On closed ones, a whole number of `period_px` fits, if that is above 0.
  StrokeFit fit(const StrokePath& path, float period_px);
  /// Notes a line of this frame for the next one.
  void remember(const StrokePath& path, const StrokeFit& fit);

 private:
  struct Place {
    LinePlace here, ahead;  // ahead: a little farther along the line
    float u_px = 0, scale = 1;
    std::uint32_t line = 0;
    // As this frame sees it.
    glm::vec2 px{0}, way{0};
    std::uint32_t next = 0;  // of the same cell
  };
  struct Vote {
    float way_px, u_px;
    std::uint32_t line;
  };
  const Place* nearest(const glm::vec2& px, const glm::vec2& way) const;
  bool keep_most_voted();
  StrokeFit fit_votes() const;

  std::vector<Place> last_, now_;
  std::array<std::uint32_t, 4096> cells_{};
  std::uint32_t lines_ = 0;
  std::vector<Vote> votes_;
  std::vector<std::uint32_t> counts_;
  mutable std::vector<float> sorted_;
};

}  // namespace rinkaku::outline
