#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "outline/corrected_curvature.h"
#include "outline/face_stars.h"

namespace rinkaku::outline {

/// The discrete mean curvature that Matsuo's thesis takes from Meyer, Desbrun, Schröder and Barr, "Discrete
/// differential-geometry operators for triangulated 2-manifolds" (2003): with the angles alpha and beta that face the
/// edge from x to its neighbour xj and the area A around x,
///   K n = 1 / (4 A) sum (cot alpha + cot beta) (xj - x),  A = 1/8 sum (cot alpha + cot beta) |xj - x|^2,
/// of which the length is the mean curvature; here it has the sign of -K n . n, so that convex is positive. In place of
/// A, which vanishes or becomes negative at obtuse triangles, stands the paper's mixed area, equal to A where no
/// triangle is obtuse. The Gaussian curvature is the angle defect over the same area.
///
/// Faces flatter than 1e-4 of their longest edge are left out, as their cotangents are rounding. On a border only the
/// part of K n along the normal counts (the rest pulls along the surface), and the Gaussian curvature is the mean of
/// the neighbours off the border (0 if there is none), as the angles there measure the border's own turning.
class MeyerCurvature {
 public:
  explicit MeyerCurvature(const FaceStars& stars);

  /// `stars` and `points` as for CorrectedCurvature::run(); `values` gets a value for each point. Allocates nothing.
  void run(const FaceStars& stars, std::span<const glm::vec4> points, std::span<MeanAndGauss> values);

  double area(std::size_t point) const { return sums_[point].area; }  ///< the mixed area, of scaled points

 private:
  struct Sums {
    glm::dvec3 pull{0};    // of (cot alpha + cot beta) (xj - x)
    glm::dvec3 normal{0};  // weighted by area
    double area = 0;
    double angle = 0;
  };
  void add_face(const glm::uvec3& face, std::span<const glm::vec4> points);

  std::vector<Sums> sums_;
};

}  // namespace rinkaku::outline
