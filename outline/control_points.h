#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "mesh/topology.h"
#include "outline/feature_points.h"
#include "outline/ring_smoothing.h"

namespace rinkaku::outline {

/// Control points spread evenly over a sphere around the surface's bounding box, `distance` of its half diagonal beyond
/// it (a Fibonacci spiral). In the topology's coordinates.
std::vector<glm::vec3> control_points_on_sphere(const mesh::Topology& topology, int count, double distance);

/// Control points along the shape: over points of the surface that are as far from each other as can be, `distance` of
/// the bounding box's half diagonal above it, so that all parts of the surface have one equally near (the thesis's wish
/// in 3.2.5). Cost: count x points.
std::vector<glm::vec3> control_points_along(const mesh::Topology& topology, int count, double distance);

struct ControlOptions {
  FeaturePointOptions features{};
  double exaggeration = 1;  ///< the most that is added to the base line, in base lines
  /// d0: from this distance on inwards that much is added; 0: what a tenth of the features have at rest.
  double reach = 0;
  /// How far a feature xi is from its control point xj: |xi - xj|; or, as equation 3.5 is printed, | |xi| - |xj| |.
  enum class Distance { Apart, Lengths } distance = Distance::Apart;
  int smoothing = 3;  ///< as for curvature
};

/// What a line's width is multiplied by at points of a surface: the feature points are pushed out further along their
/// normals by an amount that the nearest control point sets (equation 3.5 of Matsuo's thesis, u = d0 squared), with the
/// printed formula's singularity capped:
///     factor = 1 + exaggeration min((d0 / d)^2, 1)    at features, 1 elsewhere; then smoothed.
/// d is measured from the surface; the hull lies less than a line's width off it.
///
/// Each point keeps the control point that is nearest at rest, and control points keep their place relative to the
/// surface next to them, so both go with a surface that moves. Keeps no reference. Allocates nothing once warm.
class ControlWidths {
 public:
  ControlWidths(const mesh::Topology& rest, double k95, std::span<const glm::vec3> controls,
                const ControlOptions& options);

  /// All factors; until the next call.
  std::span<const float> at(std::span<const glm::vec3> points);
  /// As CurvatureWidths.
  void at(std::span<const glm::vec3> points, std::span<const std::uint32_t> wanted, std::span<float> factors);

  /// Where the control points are in this pose.
  std::span<const glm::vec3> controls(std::span<const glm::vec3> points);

 private:
  // A control point in the coordinates of a face next to it.
  struct Anchor {
    glm::uvec3 face;
    glm::dvec3 place{0};
  };
  void attach(const mesh::Topology& rest, std::span<const glm::vec3> controls);
  double distance(const glm::vec3& point, const glm::vec3& control) const;
  void find(std::span<const glm::vec3> points, std::span<const std::uint32_t> needed);

  ControlOptions options_;
  FeaturePoints features_;
  RingSmoothing smoothing_;
  std::vector<Anchor> anchors_;
  std::vector<std::uint32_t> nearest_;  // per point: its control point
  std::vector<glm::vec3> controls_;     // as they are now
  std::vector<float> factors_;
};

}  // namespace rinkaku::outline
