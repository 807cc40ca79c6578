#pragma once

#include <array>
#include <optional>

#include "outline/width_options.h"
#include "pipeline/scene/control.h"
#include "pipeline/scene/line_style.h"
#include "pipeline/scene/line_weight.h"
#include "pipeline/toml/table.h"

namespace rinkaku::pipeline {

/// No line is wider, whether a scene or a mesh's file asks for it.
inline constexpr double most_line_px = 100, most_line_m = 1000;

/// outline of [[object]]: its line.
struct OutlineScene {
  /// What the scene leaves open, the mesh's file may set: see with_file_line().
  bool own_width = false, own_colour = false;
  double width_px = 3;
  std::optional<double> width_m;  ///< in place of width_px
  double min_px = 0;              ///< for width_m
  double max_px = 40;
  double lean = 3;  ///< pixels of depth per pixel of width, over what lies close behind: outline::LineRoom; 0: none
  double taper_px = usual_taper_px(LineMethod::Uniform);  ///< 0: lines end blunt
  std::array<double, 3> colour{0.07, 0.05, 0.09};         ///< sRGB
  using Method = LineMethod;
  Method method = Method::Uniform;
  LineStyleScene style;  ///< what some methods have besides
  // For the method Curvature; see outline/width_options.h.
  using Curvature = outline::CurvatureKind;
  using Sign = outline::CurvatureSign;
  Curvature curvature = Curvature::Mean;
  Sign sign = Sign::Magnitude;
  double exaggeration = 1;
  double saturation = 1;
  double curve = 1;
  double min_factor = 0.25;
  int smoothing = 3;
  double thickness_part = 0.5;  ///< the most that is added to the width, in thicknesses of the body; 0: any width
  LineWeightScene weight;
  ControlScene control;  ///< for the method Control, which has exaggeration, smoothing and thickness_part as well
};

toml::Schema outline_schema();

/// Empty if there is none, or for `outline = false`. Throws Error (Input).
std::optional<OutlineScene> read_outline(const toml::Table& object);

}  // namespace rinkaku::pipeline
