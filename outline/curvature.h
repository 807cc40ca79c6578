#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "mesh/topology.h"
#include "outline/corrected_curvature.h"
#include "outline/face_stars.h"
#include "outline/meyer_curvature.h"
#include "outline/quadric_fit.h"
#include "outline/uneven_stars.h"

namespace rinkaku::outline {

enum class CurvatureMethod {
  Meyer,    ///< cotangents: MeyerCurvature; fast, but bad on slivers and irregular triangles
  Icnc,     ///< interpolated corrected curvature, one ring: CorrectedCurvature; fast and robust
  Quadric,  ///< two-ring fit: QuadricFit; the best on smooth surfaces without slivers, slow
  Auto,     ///< Icnc, averaged over more of the surface where triangles are irregular: UnevenStars
};

/// Curvatures at each point of a welded surface, in 1 / unit and 1 / unit^2 of its points. Convex (seen from outside)
/// is positive, a unit sphere has mean 1 and Gaussian 1. Always finite: points without area around them have 0, and
/// radii below a ten-billionth of the object count as that.
struct Curvature {
  std::vector<float> mean;
  std::vector<float> gauss;
  std::vector<float> largest;   ///< principal curvature, mean + sqrt(mean^2 - gauss)
  std::vector<float> smallest;  ///< principal curvature, mean - sqrt(mean^2 - gauss)
  std::vector<float> area;      ///< of the surface that is the point's own, unit^2
};

/// Computes curvature again and again for one connectivity, while the points move: keeps connectivity and scratch, so
/// that solve() allocates nothing.
///
/// Borders: the one-sided neighbourhood that there is counts. Icnc integrates over the faces there are, so an open
/// cylinder keeps its curvature up to its rim; Meyer and Quadric say in their headers what they do. Faces whose
/// windings disagree are turned alike first; at edges of more than two faces all of them count. Any thread, one at a
/// time. Cost for 63,684 points: docs/curvature.md.
class CurvatureSolver {
 public:
  explicit CurvatureSolver(const mesh::Topology& topology, CurvatureMethod method = CurvatureMethod::Icnc);

  /// `points`: finite positions in the topology's order. Any size and place; but a float far from the origin is coarse,
  /// so place objects by their transform.
  const Curvature& solve(std::span<const glm::vec3> points);

  /// The same at some points only; elsewhere the result is not defined. In Icnc's case only their surroundings are
  /// looked at, and in the scale of the topology's own points, so that poses may be a thousand times larger or smaller.
  const Curvature& solve_at(std::span<const glm::vec3> points, std::span<const std::uint32_t> wanted);

  const FaceStars& stars() const { return stars_; }

 private:
  double scale_points(std::span<const glm::vec3> points);
  void finish(double scale);
  void finish(double scale, std::size_t point);

  FaceStars stars_;
  CurvatureMethod method_;
  double rest_scale_ = 0;
  CorrectedCurvature corrected_;
  std::optional<MeyerCurvature> meyer_;
  std::optional<QuadricFit> quadric_;
  std::optional<UnevenStars> uneven_;
  std::vector<glm::vec4> scaled_;
  std::vector<MeanAndGauss> values_;
  Curvature curvature_;
};

/// The curvature of a mesh as it is. Cost: one solve, and 10 ns a triangle to set up (Quadric: 60).
Curvature curvature(const mesh::Topology& topology, CurvatureMethod method = CurvatureMethod::Icnc);

/// What scaled points are multiplied by to be CorrectedCurvature::kSize across: a power of two, so nothing is rounded.
/// Points in no face are left out. 0 if all are at one place.
double curvature_scale(const FaceStars& stars, std::span<const glm::vec3> points);

/// K95, by which lines normalise curvature: 95 % of the surface's area has a mean curvature of at most this size. Taken
/// once from the rest pose of what moves, so that widths don't pump. 0 for a flat surface. Allocates.
double k95(const Curvature& curvature);

}  // namespace rinkaku::outline
