#include "pipeline/scene/line_style.h"

#include <algorithm>
#include <string>

#include "pipeline/scene/values.h"

namespace rinkaku::pipeline {
namespace {

using toml::Limits;
using toml::Table;
using M = LineMethod;

constexpr NamedMethod kMethods[] = {{"uniform", M::Uniform},
                                    {"curvature", M::Curvature},
                                    {"hull", M::Hull},
                                    {"depth_normals", M::DepthNormals},
                                    {"silhouette", M::Silhouette},
                                    {"laplacian", M::Laplacian},
                                    {"z_lines", M::ZLines},
                                    {"hidden_lines", M::HiddenLines},
                                    {"facing", M::Facing},
                                    {"isophote", M::Isophote},
                                    {"wobble", M::Wobble},
                                    {"strokes", M::Strokes},
                                    {"control", M::Control}};

// A key, and the methods that have it.
struct KeyOf {
  std::string_view key;
  std::vector<LineMethod> methods;
};

const std::vector<KeyOf>& keys_of_methods() {
  static const std::vector<KeyOf> all = {
      {"threshold", {M::Facing, M::Isophote}},
      {"depth_step", {M::DepthNormals}},
      {"normal_deg", {M::DepthNormals}},
      {"contrast", {M::Laplacian}},
      {"max_factor", {M::Isophote}},
      {"hidden", {M::HiddenLines}},
      {"wobble", {M::Wobble}},
      {"wave", {M::Wobble}},
      {"redraw_frames", {M::Wobble}},
      {"brush", {M::Strokes}},
      {"brush_px", {M::Strokes}},
      {"stroke_px", {M::Strokes}},
      {"gap", {M::Strokes}},
      {"pressure", {M::Strokes}},
      {"dryness", {M::Strokes}},
  };
  return all;
}

void refuse_keys_of_others(const Table& outline, LineMethod method) {
  for (const KeyOf& of : keys_of_methods()) {
    if (!outline.has(of.key) || std::find(of.methods.begin(), of.methods.end(), method) != of.methods.end()) continue;
    std::string words;
    for (const LineMethod m : of.methods) {
      words += (words.empty() ? "\"" : " or \"") + std::string(word_for(m)) + "\"";
    }
    throw outline.error_at(of.key, "goes with method = " + words, "add that, or leave it out");
  }
  if (method == M::Facing) {
    for (const std::string_view key : {"width_px", "width_m"}) {
      if (outline.has(key)) {
        throw outline.error_at(key, "has no meaning with method = \"facing\"", "give 'threshold' in its place");
      }
    }
  }
  if (outline.has("taper_px") && !follows_edges(method)) {
    throw outline.error_at("taper_px", "goes with methods whose lines follow edges of the mesh",
                           "leave it out, or choose another 'method'");
  }
}

InnerLinesScene read_inner(const Table& inner) {
  InnerLinesScene scene;
  scene.creases = inner.flag("creases").value_or(scene.creases);
  scene.crease_deg = inner.number("crease_deg", {0, 180}).value_or(scene.crease_deg);
  scene.materials = inner.flag("materials").value_or(scene.materials);
  scene.cuts = inner.flag("cuts").value_or(scene.cuts);
  scene.width_px = inner.number("width_px", Limits::above(0, 100));
  scene.colour = read_colour(inner, "colour");
  return scene;
}

}  // namespace

std::span<const NamedMethod> line_methods() { return kMethods; }

std::string_view word_for(LineMethod method) {
  return std::find_if(std::begin(kMethods), std::end(kMethods),
                      [method](const NamedMethod& named) { return named.method == method; })
      ->word;
}

bool follows_edges(LineMethod method) {
  return method == M::Uniform || method == M::Curvature || method == M::Control || method == M::ZLines ||
         method == M::HiddenLines || method == M::Isophote || method == M::Wobble || method == M::Strokes;
}

bool pushes_contour(LineMethod method) {
  return method == M::Uniform || method == M::Curvature || method == M::Control || method == M::ZLines ||
         method == M::HiddenLines;
}

void require_pushed_contour(const toml::Table& outline, std::string_view key, LineMethod method) {
  if (!outline.has(key) || pushes_contour(method)) return;
  throw outline.error_at(key,
                         "goes with method = \"uniform\", \"curvature\", \"control\", \"z_lines\" or \"hidden_lines\"",
                         "choose one of these, or leave it out");
}

bool brings_inner_lines(LineMethod method) { return method == M::ZLines || method == M::HiddenLines; }

double usual_taper_px(LineMethod method) {
  if (method == M::Uniform || method == M::Wobble) return 6;
  return method == M::Curvature || method == M::Control || method == M::Isophote || method == M::Strokes ? 15 : 0;
}

bool needs_own_targets(LineMethod method) {
  return method == M::DepthNormals || method == M::Silhouette || method == M::Laplacian || method == M::HiddenLines ||
         method == M::Isophote || method == M::Wobble || method == M::Strokes;
}

std::vector<std::string_view> line_style_keys() {
  std::vector<std::string_view> keys = {"inner", "drawn"};
  for (const KeyOf& of : keys_of_methods()) keys.push_back(of.key);
  return keys;
}

toml::Schema line_style_schema() {
  return {
      {.path = "object.outline.inner", .keys = {"creases", "crease_deg", "materials", "cuts", "width_px", "colour"}}};
}

LineStyleScene read_line_style(const Table& outline, LineMethod method) {
  refuse_keys_of_others(outline, method);
  LineStyleScene s;
  if (method == M::Isophote) s.threshold = kIsophoteThreshold;
  s.threshold = outline.number("threshold", Limits::above(0, 0.95)).value_or(s.threshold);
  s.depth_step = outline.number("depth_step", Limits::above(0, 10)).value_or(s.depth_step);
  s.normal_deg = outline.number("normal_deg", Limits::above(0, 180)).value_or(s.normal_deg);
  s.contrast = outline.number("contrast", Limits::above(0, 1)).value_or(s.contrast);
  s.most_factor = outline.number("max_factor", {1, 20}).value_or(s.most_factor);
  s.hidden = outline.number("hidden", {0, 1}).value_or(s.hidden);
  s.wobble = outline.number("wobble", {0, 2}).value_or(s.wobble);
  s.wave = outline.number("wave", Limits::above(0, 10)).value_or(s.wave);
  s.redraw_frames = static_cast<int>(outline.integer("redraw_frames", 0, 100000).value_or(s.redraw_frames));
  if (outline.has("brush")) s.brush = existing_file(outline, "brush");
  if (outline.has("drawn")) s.drawn = existing_file(outline, "drawn");
  s.brush_px = outline.number("brush_px", Limits::above(0, 10000)).value_or(s.brush_px);
  s.stroke_px = outline.number("stroke_px", {0, 100000}).value_or(s.stroke_px);
  s.gap = outline.number("gap", {0, 0.6}).value_or(s.gap);
  s.pressure = outline.number("pressure", {0, 1}).value_or(s.pressure);
  s.dryness = outline.number("dryness", {0, 1}).value_or(s.dryness);
  if (const auto inner = outline.table_unless_flag("inner")) {
    s.inner = read_inner(*inner);
  } else if (outline.has("inner") ? *outline.flag("inner") : brings_inner_lines(method)) {
    s.inner.emplace();
  }
  return s;
}

}  // namespace rinkaku::pipeline
