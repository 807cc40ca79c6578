#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "pipeline/toml/table.h"

namespace rinkaku::pipeline {

/// How lines are found and drawn; docs/outlines.md describes each.
enum class LineMethod {
  Uniform,
  Curvature,
  Hull,
  DepthNormals,
  Silhouette,
  Laplacian,
  ZLines,
  HiddenLines,
  Facing,
  Isophote,
  Wobble,
  Strokes,
  Control,
};

/// A method and its word in the scene file.
struct NamedMethod {
  const char* word;
  LineMethod method;
};
std::span<const NamedMethod> line_methods();
std::string_view word_for(LineMethod method);

/// Whether a method draws lines along edges of the mesh, which can end, and thin out there.
bool follows_edges(LineMethod method);

/// Whether all of the method's contour lines are the contour pushed outwards (outline::HullPass), which can be weighed
/// and lean back.
bool pushes_contour(LineMethod method);
/// Throws Error (Input) if `outline` has the key and the method doesn't push the contour.
void require_pushed_contour(const toml::Table& outline, std::string_view key, LineMethod method);

/// Over which length lines thin out towards their ends if the scene doesn't say, in pixels.
double usual_taper_px(LineMethod method);

/// Whether it draws lines within the shape unless told not to.
bool brings_inner_lines(LineMethod method);

/// Whether the method needs pictures of the object, drawn into targets of its own.
bool needs_own_targets(LineMethod method);

/// inner of outline: lines within the shape.
struct InnerLinesScene {
  bool creases = true;
  double crease_deg = 60;
  bool materials = true;
  bool cuts = true;
  std::optional<double> width_px;               ///< half of the outline's if not given
  std::optional<std::array<double, 3>> colour;  ///< sRGB; the outline's, lighter, if not given
};

inline constexpr double kIsophoteThreshold = 0.4;

/// What one method or another needs of outline's keys.
struct LineStyleScene {
  double threshold = 0.3;       ///< Facing, Isophote: of the cosine to the line of sight; see kIsophoteThreshold
  double depth_step = 0.03;     ///< DepthNormals: the least step in depth, in radii of the mesh
  double normal_deg = 25;       ///< DepthNormals: the least angle between normals
  double contrast = 0.08;       ///< Laplacian: the least step between colours
  double most_factor = 3;       ///< Isophote: the widest line, in widths
  double hidden = 0.5;          ///< HiddenLines: how strong hidden lines are
  double wobble = 0.5;          ///< Wobble: in widths
  double wave = 0.12;           ///< Wobble: size of wobbles, in radii of the mesh
  int redraw_frames = 0;        ///< Wobble: anew after so many frames
  std::filesystem::path brush;  ///< Strokes: an image; empty: a brush's bristles
  double brush_px = 160;        ///< Strokes: the length that one image takes
  double stroke_px = 240;       ///< Strokes: the length of one stroke; 0: unbroken
  double gap = 0;               ///< Strokes: the part of it that stays empty
  double pressure = 0.6;        ///< Strokes: how much a stroke follows the pen's pressure
  double dryness = 0;           ///< Strokes: how much of the paper stays bare
  std::optional<InnerLinesScene> inner;
  std::filesystem::path drawn;  ///< lines that were drawn on the object, see drawn_lines_file.h; empty: none
};

/// The keys of `outline` that read_line_style() reads, and the schema of those that are tables.
std::vector<std::string_view> line_style_keys();
toml::Schema line_style_schema();

/// Reads what the method has, of the table `outline`. Throws Error (Input), also for keys of other methods.
LineStyleScene read_line_style(const toml::Table& outline, LineMethod method);

}  // namespace rinkaku::pipeline
