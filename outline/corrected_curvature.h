#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "outline/face_stars.h"

namespace rinkaku::outline {

/// What the corrected curvature measures of a point's faces add up to.
struct Measures {
  float area = 0;       ///< mu0: the area as the vertex normals see it
  float mean = 0;       ///< mu1: twice the mean curvature, times area
  float gauss = 0;      ///< mu2: Gaussian curvature times area
  float flat_area = 0;  ///< the area of the faces themselves
};

/// Interpolated corrected curvature measures of the faces around each point.
///
/// Lachaud, Romon, Thibert and Coeurjolly, "Interpolated corrected curvature measures for polygonal surfaces" (2020):
/// with vertex normals u, their mean v and edges a = xj - xi, b = xk - xi of a face ijk,
///   mu0 = 1/2 v . (a x b),  mu1 = 1/2 v . ((ui - uk) x a + (uj - ui) x b),  mu2 = 1/2 ui . (uj x uk).
/// No cotangent and no division by a face's area, so slivers do no harm. The normals are those of Max ("Weights for
/// computing vertex normals from facet normals", 1999), exact on spheres; edges shorter than a thousandth of their
/// face's longest count as that long, as their direction is mostly rounding.
///
/// Two passes over the faces, 64 at a time side by side, each added to its corners in the order of the faces. In float:
/// everything is relative to one corner of the face. Keeps its storage: nothing is allocated after construction.
class CorrectedCurvature {
 public:
  explicit CorrectedCurvature(const FaceStars& stars);

  /// `points`: x, y, z of each point (w is not read), scaled so that the whole object is roughly kSize across.
  /// `stars`: as at construction.
  void run(const FaceStars& stars, std::span<const glm::vec4> points);

  /// The same around some points only: their measures, and the normals at them and their neighbours, are then as run()
  /// gives them, up to rounding; those elsewhere are not defined. `points` are not scaled yet; they are read at the
  /// first and second ring only. Costs some twice as much a point; allocates until it has been asked for as many.
  void run_at(const FaceStars& stars, std::span<const glm::vec3> points, float scale,
              std::span<const std::uint32_t> wanted);

  std::span<const glm::vec4> normals() const { return normals_; }  ///< unit, or 0 where there is no area; w is 0
  std::span<const Measures> measures() const { return measures_; }

  /// The size of an object at which no product of edges leaves the range of float, from 1e-9 of the object's size on.
  static constexpr double kSize = 1024;

 private:
  void add_normals(std::span<const glm::uvec3> faces, std::span<const glm::vec4> points);
  void add_measures(std::span<const glm::uvec3> faces, std::span<const glm::vec4> points);

  std::vector<glm::vec4> normals_;
  std::vector<Measures> measures_;
  // Of the part that run_at() is asked for: faces around the wanted points, and around those faces' corners.
  std::vector<glm::uvec3> inner_faces_, faces_;
  std::vector<std::uint32_t> ring_, second_ring_;   // the corners of these
  std::vector<glm::vec4> scaled_;                   // per point, where needed
  std::vector<std::uint32_t> seen_face_, seen_at_;  // per face and point: by which sweep
  std::uint32_t sweep_ = 0;
};

struct MeanAndGauss {
  float mean = 0;
  float gauss = 0;
};

/// Curvatures out of sums of measures, in 1 / unit and 1 / unit^2 of the scaled points; 0 where there is no area. Where
/// the surface folds so far that the normals see less than a twentieth of its area, that twentieth is divided by.
MeanAndGauss from_measures(const Measures& sum);

}  // namespace rinkaku::outline
