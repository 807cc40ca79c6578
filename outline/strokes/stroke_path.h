#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "outline/strokes/chains.h"

namespace rinkaku::outline {

/// Positions that lie in an array of anything.
struct PositionView {
  const std::byte* first = nullptr;
  std::size_t stride = sizeof(glm::vec3);
  const glm::vec3& operator[](std::size_t i) const { return *reinterpret_cast<const glm::vec3*>(first + i * stride); }
};

/// What lines run through: a mesh's vertices and places that are numbered after them.
struct LinePoints {
  PositionView own;
  std::size_t own_count = 0;
  std::span<const glm::vec3> more{};
  const glm::vec3& operator[](std::uint32_t v) const { return v < own_count ? own[v] : more[v - own_count]; }
};

/// A place on the way from one of these to another, which stays there however they move.
struct LinePlace {
  std::uint32_t from = 0, to = 0;
  float part = 0;  ///< of the way
  glm::vec3 on(const LinePoints& points) const { return glm::mix(points[from], points[to], part); }
};

/// A place along a line as it is seen.
struct StrokeSample {
  LinePlace place;
  glm::vec3 position{0};  ///< on the shape, in the object's coordinates
  glm::vec2 px{0};        ///< where it is seen, pixels of the pinhole picture
  glm::vec2 shift_px{0};  ///< what smoothing moves it by
  glm::vec2 normal{0};    ///< to the left of the way on the screen (rows run downwards); at bends longer than 1
  float depth_m = 0;
  float way_px = 0;    ///< from the line's start
  float width_px = 0;  ///< of the line here
};

struct PathOptions {
  float step_px = 3;  ///< samples lie no farther apart
  int smoothing = 4;  ///< how often places, widths and normals become the mean of themselves and their neighbours'
  float most_shift_px = 1.5f;
  float most_growth = 1e6f;  ///< by how much the width may change a pixel of the way
};

/// A chain as it is seen: samples at even distances. No GL. Allocates nothing once warm.
class StrokePath {
 public:
  /// `to_pixels` takes a position to (x Z, y Z, Z, Z), x and y in pixels of the pinhole picture. `widths_px` are per
  /// vertex of the chain. Where a vertex is nearer than `near_m`, the path breaks off: the rest is left out.
  void trace(std::span<const std::uint32_t> vertices, std::span<const float> widths_px, const LinePoints& points,
             const glm::mat4& to_pixels, bool closed, const PathOptions& options);

  std::span<StrokeSample> samples() { return samples_; }
  std::span<const StrokeSample> samples() const { return samples_; }
  bool closed() const { return closed_; }
  float length_px() const { return samples_.empty() ? 0 : samples_.back().way_px; }

 private:
  void smooth(const PathOptions& options);
  void limit_growth(float most_growth);
  void find_normals();
  void smooth_normals(int rounds);

  bool closed_ = false;
  std::vector<StrokeSample> samples_;
  std::vector<StrokeSample> before_;
};

}  // namespace rinkaku::outline
