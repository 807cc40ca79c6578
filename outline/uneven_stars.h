#pragma once

#include <span>
#include <vector>

#include <glm/vec4.hpp>

#include "outline/corrected_curvature.h"
#include "outline/face_stars.h"

namespace rinkaku::outline {

/// Averages curvatures over more of the surface where a point's faces lie unevenly around it.
///
/// Vertex normals, and with them one-ring curvatures, are right to second order where a point lies in the middle of its
/// faces, and noisy where it does not. So each point's unevenness is measured: how far the centroid of its faces lies
/// off it along the surface, 0 to 1, the largest of it and its neighbours. Below 0.15 the value stays as it is, from
/// 0.3 on it is the mean over its neighbours' means (weighted by corrected area), and in between it is blended.
class UnevenStars {
 public:
  explicit UnevenStars(const FaceStars& stars);

  /// `points`, `normals` and `measures`: as CorrectedCurvature's. Allocates nothing. About 0.1 microseconds a point.
  void average(const FaceStars& stars, std::span<const glm::vec4> points, std::span<const glm::vec4> normals,
               std::span<const Measures> measures, std::span<MeanAndGauss> values);

 private:
  void find_unevenness(const FaceStars& stars, std::span<const glm::vec4> points, std::span<const glm::vec4> normals);

  std::vector<float> unevenness_;
  std::vector<MeanAndGauss> once_, twice_;
};

}  // namespace rinkaku::outline
