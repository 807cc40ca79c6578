#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "outline/feature_points.h"
#include "pipeline/toml/table.h"

namespace rinkaku::pipeline {

/// control of outline of [[object]]: feature and control points, which say where its line gets thicker.
struct ControlScene {
  // Where the control points are; by default along the shape.
  std::vector<glm::dvec3> points_m;  ///< by hand: in the world, as the object stands at rest
  int on_sphere = 0;                 ///< so many on a sphere around it
  int along = 60;                    ///< so many along the shape, if there are no others
  double distance = 0.1;             ///< how far off, in half diagonals of the mesh's bounding box
  std::optional<double> reach_m;     ///< d0; empty: a tenth of the features lie within it
  bool lengths = false;              ///< equation 3.5 as printed: by how much the vectors' lengths differ
  outline::FeaturePointOptions features{};
};

toml::Schema control_schema();

/// Defaults if there is none. Throws Error (Input).
ControlScene read_control(const toml::Table& outline);

}  // namespace rinkaku::pipeline
