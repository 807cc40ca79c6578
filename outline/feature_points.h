#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "mesh/topology.h"
#include "outline/face_stars.h"
#include "outline/point_neighbours.h"

namespace rinkaku::outline {

/// When a point of a surface is a feature.
struct FeaturePointOptions {
  /// Thresholds on how much the surface bends along an edge: on the sum of angles itself in degrees, as the thesis has
  /// it (A below 180, B above); or on its excess over 180 degrees by the edge's length, which is about the curvature
  /// along the edge, in K95 (both above 0).
  enum class By { Degrees, K95 } by = By::K95;
  double concave = 1;  ///< A; 0 in K95, or 0 degrees: no concave features
  double convex = 1;   ///< B; 0 in K95, or 360 degrees: no convex features
  int comparison = 1;  ///< more neighbours than this must pass
};

/// Feature points after chapter 3 of Matsuo's thesis on exaggerated outlines (equations 3.1 to 3.4).
///
/// For the edge from a point P1 to a neighbour P2, theta1 is the angle between it and the normal N1, theta2 the one
/// between its reverse and N2. Their sum is 180 degrees on a flat surface, less in hollows (3.1), more on humps (3.3).
/// A neighbour counts as concave for A > theta1 + theta2 (3.2), as convex for B < theta1 + theta2 (3.4); a point is a
/// feature if more than `comparison` of its neighbours count. Normals are means of the unit normals of the faces
/// around, as printed; points without any are no features.
///
/// Any pose of the connectivity. Keeps no reference to the topology. Allocates nothing after construction.
class FeaturePoints {
 public:
  /// `k95` of the rest pose, for thresholds that count in it.
  FeaturePoints(const mesh::Topology& rest, double k95, const FeaturePointOptions& options);

  enum class Kind : std::uint8_t { None, Concave, Convex };
  /// Which of some points are features, as `points` are now. Valid at `wanted` until the next call. A point that passes
  /// as both is what more of its neighbours say. About 0.5 microseconds a point.
  std::span<const Kind> find(std::span<const glm::vec3> points, std::span<const std::uint32_t> wanted);

 private:
  glm::vec3 normal_at(std::span<const glm::vec3> points, std::uint32_t point);
  Kind kind_of(std::span<const glm::vec3> points, std::uint32_t point);

  FeaturePointOptions options_;
  double k95_;
  FaceStars stars_;
  PointNeighbours neighbours_;
  std::vector<Kind> kinds_;
  std::vector<glm::vec3> normals_;
  std::vector<std::uint32_t> normal_of_;  // per point: the call that found its normal
  std::uint32_t call_ = 0;
};

/// theta1 + theta2 in radians for an edge from `p1` to `p2` with unit normals there; pi for points at one place.
double angle_sum(const glm::vec3& p1, const glm::vec3& n1, const glm::vec3& p2, const glm::vec3& n2);

}  // namespace rinkaku::outline
