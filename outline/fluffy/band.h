#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "outline/fluffy/frame.h"

namespace rinkaku::fluffy {

/// What the band about the contour is found on: triangles whose corners have a place and a normal.
///
/// A corner's facing is the cosine between its normal and the way to the eye: 1 seen from above, 0 on edge. Inside a
/// triangle facing is interpolated, as a shader does it. A triangle is in the band of full width w if facing lies
/// between -sin(w / 2) and sin(w / 2) anywhere in it: if w is how far about perpendicular to the line of sight a place
/// still counts as near the contour, half of it on either side.
struct BandSurface {
  std::vector<glm::vec3> points;
  std::vector<glm::vec3> normals;     ///< unit
  std::vector<glm::uvec3> triangles;  ///< indices of points
};

/// The frame's triangles with its points' normals: what is drawn.
BandSurface by_corners(const Frame& frame);

/// Each triangle as one place, its middle, with its own normal: in the band as a whole or not at all, as the paper has
/// it.
BandSurface by_faces(const Frame& frame);

/// sin(w / 2) for a full width of w radians, 0 < w < pi.
double band_sine(double width_rad);

/// Whether a triangle is in the band, in double: what every faster way is held against.
bool in_band(const BandSurface& surface, std::size_t triangle, double sine, const glm::dvec3& eye);

/// Finds the triangles in the band for one eye after the other.
///
/// It takes 1e-5 more than `sine`, so that no triangle is missed by rounding. Not thread-safe; find() allocates
/// nothing. Cost of find(): about 2 ns a point and 2 ns a triangle.
class BandCut {
 public:
  BandCut(BandSurface surface, double sine);

  /// Triangles, ascending. The span lives until the next find().
  std::span<const std::uint32_t> find(const glm::dvec3& eye);

  /// Other places and normals for the same triangles, as an animated mesh has them each frame.
  void move(std::span<const glm::vec3> points, std::span<const glm::vec3> normals);

 private:
  std::vector<glm::uvec3> triangles_;
  float sine_;
  std::vector<float> x_, y_, z_, nx_, ny_, nz_;
  std::vector<float> facing_;
  std::vector<std::uint32_t> found_;
};

}  // namespace rinkaku::fluffy
