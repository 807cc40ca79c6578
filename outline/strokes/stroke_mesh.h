#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "outline/strokes/stroke_memory.h"
#include "outline/strokes/stroke_path.h"

namespace rinkaku::outline {

/// A vertex of a stroke's strip.
struct StrokeVertex {
  glm::vec3 position{0};  ///< on the shape, in the object's coordinates: what is seen there, the stroke is
  glm::vec2 push_px{0};   ///< on the screen
  glm::vec2 along_px{0};  ///< along the stroke, and across it from its middle
  float half_px = 0;      ///< half the stroke's width here
  float to_end_px = 0;    ///< to the line's nearer end
  float strength = 1;     ///< below 1 where the stroke is thinner than a pixel, which is as thin as one is drawn
};

struct StrokeBand {
  bool outside = false;   ///< the stroke lies to the right of the way; else in its middle
  bool mirrored = false;  ///< then to the left
  float wobble = 0;       ///< how much of its width a line is thicker and thinner, and displaced
  float wave = 1;         ///< size of wobbles, in the object's coordinates
  /// Where the points were at rest, if they have moved since: wobbles are fixed to the shape there.
  const LinePoints* rest = nullptr;
  std::uint32_t draft = 0;  ///< another number wobbles otherwise
};

/// Strips of triangles along lines. No GL. Allocates nothing once warm.
class StrokeMesh {
 public:
  void clear();
  void add(const StrokePath& path, const StrokeFit& fit, const StrokeBand& band);
  std::span<const StrokeVertex> vertices() const { return vertices_; }
  std::span<const std::uint32_t> indices() const { return indices_; }

 private:
  std::vector<StrokeVertex> vertices_;
  std::vector<std::uint32_t> indices_;
};

/// Smooth noise between -1 and 1 with bends about 1 apart; the same for the same place and draft.
float smooth_noise(const glm::vec3& place, std::uint32_t draft);

}  // namespace rinkaku::outline
