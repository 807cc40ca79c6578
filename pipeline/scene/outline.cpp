#include "pipeline/scene/outline.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "pipeline/scene/values.h"

namespace rinkaku::pipeline {
namespace {

using toml::Limits;
using toml::Table;

void read_method(const Table& outline, OutlineScene& scene) {
  const auto word = outline.text("method");
  if (!word) return;
  std::string expected;
  for (const NamedMethod& named : line_methods()) {
    if (*word == named.word) {
      scene.method = named.method;
      return;
    }
    expected += (expected.empty() ? "\"" : ", \"") + std::string(named.word) + "\"";
  }
  throw outline.wrong("method", "one of " + expected);
}

void read_width(const Table& outline, OutlineScene& scene) {
  outline.exclude("width_px", "width_m");
  scene.own_width = outline.has("width_px") || outline.has("width_m");
  scene.width_px = outline.number("width_px", Limits::above(0, most_line_px)).value_or(scene.width_px);
  scene.width_m = outline.number("width_m", Limits::above(0, most_line_m));
  for (const std::string_view key : {"min_px", "max_px"}) {
    if (outline.has(key) && !scene.width_m) {
      throw outline.error_at(key, "goes with 'width_m'", "leave it out, or give 'width_m' in place of 'width_px'");
    }
  }
  scene.min_px = outline.number("min_px", {0, most_line_px}).value_or(scene.min_px);
  scene.max_px =
      outline.number("max_px", Limits::above(0, most_line_px)).value_or(std::max(scene.max_px, scene.min_px));
  if (scene.max_px < scene.min_px) throw outline.error_at("max_px", "must not be below 'min_px'");
}

void read_curvature_width(const Table& outline, OutlineScene& scene) {
  using O = OutlineScene;
  for (const std::string_view key : {"curvature", "sign", "saturation", "curve", "min_factor"}) {
    if (outline.has(key) && scene.method != O::Method::Curvature) {
      throw outline.error_at(key, "goes with method = \"curvature\"", "add that, or leave it out");
    }
  }
  for (const std::string_view key : {"exaggeration", "smoothing", "thickness_part"}) {
    if (outline.has(key) && scene.method != O::Method::Curvature && scene.method != O::Method::Control) {
      throw outline.error_at(key, "goes with method = \"curvature\" or \"control\"", "add that, or leave it out");
    }
  }
  require_pushed_contour(outline, "lean", scene.method);
  if (outline.has("control") && scene.method != O::Method::Control) {
    throw outline.error_at("control", "goes with method = \"control\"", "add that, or leave it out");
  }
  scene.control = read_control(outline);
  scene.curvature = read_choice<O::Curvature>(outline, "curvature",
                                              {{"mean", O::Curvature::Mean},
                                               {"gauss", O::Curvature::Gauss},
                                               {"largest", O::Curvature::Largest},
                                               {"smallest", O::Curvature::Smallest}})
                        .value_or(scene.curvature);
  scene.sign = read_choice<O::Sign>(
                   outline, "sign",
                   {{"magnitude", O::Sign::Magnitude}, {"convex", O::Sign::Convex}, {"concave", O::Sign::Concave}})
                   .value_or(scene.sign);
  scene.exaggeration = outline.number("exaggeration", {0, 20}).value_or(scene.exaggeration);
  scene.saturation = outline.number("saturation", Limits::above(0, 1000)).value_or(scene.saturation);
  scene.curve = outline.number("curve", Limits::above(0, 10)).value_or(scene.curve);
  scene.min_factor = outline.number("min_factor", Limits::above(0, 1)).value_or(scene.min_factor);
  scene.smoothing = static_cast<int>(outline.integer("smoothing", 0, 100).value_or(scene.smoothing));
  scene.lean = outline.number("lean", {0, 1000}).value_or(scene.lean);
  scene.thickness_part = outline.number("thickness_part", {0, 100}).value_or(scene.thickness_part);
}

}  // namespace

toml::Schema outline_schema() {
  toml::Section outline{.path = "object.outline",
                        .keys = {"width_px", "width_m", "min_px", "max_px", "lean", "taper_px", "colour", "method",
                                 "curvature", "sign", "exaggeration", "saturation", "curve", "min_factor", "smoothing",
                                 "thickness_part", "control", "weight"}};
  for (const std::string_view key : line_style_keys()) outline.keys.push_back(key);
  toml::Schema schema{std::move(outline)};
  for (toml::Section& section : line_style_schema()) schema.push_back(std::move(section));
  for (toml::Section& section : line_weight_schema()) schema.push_back(std::move(section));
  for (toml::Section& section : control_schema()) schema.push_back(std::move(section));
  return schema;
}

std::optional<OutlineScene> read_outline(const Table& object) {
  OutlineScene scene;
  if (const auto outline = object.table_unless_flag("outline")) {
    read_method(*outline, scene);
    read_width(*outline, scene);
    read_curvature_width(*outline, scene);
    scene.weight = read_line_weight(*outline, scene.method);
    scene.style = read_line_style(*outline, scene.method);
    scene.taper_px = outline->number("taper_px", {0, 1000}).value_or(usual_taper_px(scene.method));
    scene.own_colour = outline->has("colour");
    scene.colour = read_colour(*outline, "colour").value_or(scene.colour);
  } else if (!object.has("outline") || !*object.flag("outline")) {
    return std::nullopt;
  }
  return scene;
}

}  // namespace rinkaku::pipeline
