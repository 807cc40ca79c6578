#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include <glm/vec3.hpp>

#include "pipeline/scene/animation.h"
#include "pipeline/scene/fluffy.h"
#include "pipeline/scene/outline.h"
#include "pipeline/scene/regions.h"
#include "pipeline/scene/toon.h"
#include "pipeline/toml/table.h"

namespace rinkaku::pipeline {

/// [[object]]: a CG object, or the model of a filmed thing.
struct ObjectScene {
  std::string name;  ///< for messages; the mesh's file name if not given
  std::filesystem::path mesh;
  glm::dvec3 position_m{0, 0, 0};
  glm::dvec3 rotation_deg{0, 0, 0};  ///< about world x, then y, then z
  std::optional<double> height_m;    ///< scales the mesh so that it is this high along its up axis
  glm::dvec3 scale{1, 1, 1};         ///< used where height_m is not given
  std::optional<char> up;            ///< 'x', 'y' or 'z': the mesh's own up axis; empty: by the format
  /// What lies at position_m: the middle of the mesh's bottom (of its bounding box), or the mesh's own origin. By
  /// default the bottom, but where `scale` is given the origin.
  enum class Anchor { Base, Origin } anchor = Anchor::Base;
  double crease_deg = 60;                       ///< edges sharper than this are shaded hard
  std::optional<std::array<double, 3>> colour;  ///< sRGB; replaces the materials' base colours
  std::optional<AnimationScene> animation;
  std::optional<ToonScene> toon;  ///< empty: flat colour, unlit
  int shading_scale = 1;          ///< 1 to 4: surfaces are coloured at one such part of the resolution
  std::optional<OutlineScene> outline;
  std::optional<FluffyScene> fluffy;
  /// The model of a filmed thing: not drawn, but CG behind it is hidden.
  bool holdout = false;
  std::optional<RegionsScene> regions;
};

/// Whether colours drawn at a lower resolution are to be looked up: not where there is but one.
bool has_coarse_colour(const ObjectScene& object);

/// With the schemas of the object's own tables.
toml::Schema object_schema();

/// Throws Error (Input).
ObjectScene read_object(const toml::Table& object);

}  // namespace rinkaku::pipeline
