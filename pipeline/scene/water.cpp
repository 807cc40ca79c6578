#include "pipeline/scene/water.h"

#include <algorithm>
#include <map>
#include <variant>

#include "pipeline/scene/values.h"

namespace rinkaku::pipeline {
namespace {

using toml::Limits;
using toml::Table;

std::optional<double> as_number(const toml::Value& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value.held)) return static_cast<double>(*whole);
  if (const auto* real = std::get_if<double>(&value.held)) return *real;
  return std::nullopt;
}

/// So many numbers within the limits; empty if it is something else.
std::optional<std::vector<double>> as_numbers(const toml::Value& value, std::size_t count, const Limits& limits) {
  const auto* array = std::get_if<toml::Array>(&value.held);
  if (array == nullptr || array->size() != count) return std::nullopt;
  std::vector<double> numbers;
  for (const toml::Value& element : *array) {
    const auto number = as_number(element);
    if (!number || !(*number >= limits.least && *number <= limits.most)) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

glm::dvec2 pixel(const Table& table, std::string_view key) {
  if (!table.has(key)) throw table.missing(key);
  const auto numbers = as_numbers(*table.find(key), 2, {-1e6, 1e6});
  if (!numbers) throw table.wrong(key, "a pixel [x, y] of the recording");
  return {(*numbers)[0], (*numbers)[1]};
}

std::optional<std::vector<glm::dvec3>> as_corners(const toml::Value& value) {
  const auto* array = std::get_if<toml::Array>(&value.held);
  if (array == nullptr || array->size() < 3 || array->size() > 1000) return std::nullopt;
  std::vector<glm::dvec3> corners;
  for (const toml::Value& element : *array) {
    const auto numbers = as_numbers(element, 3, metres);
    if (!numbers) return std::nullopt;
    corners.emplace_back((*numbers)[0], (*numbers)[1], (*numbers)[2]);
  }
  return corners;
}

WaterArrowScene read_arrow(const Table& arrow) {
  WaterArrowScene scene;
  scene.frame = arrow.integer("frame", 0, 100'000'000).value_or(0);
  const std::string_view from = arrow.exactly_one({"from_px", "from_m"});
  scene.where = arrow.where(from);
  scene.on_screen = from == "from_px";
  if (scene.on_screen) {
    scene.from_px = pixel(arrow, "from_px"), scene.to_px = pixel(arrow, "to_px");
  } else {
    scene.from_m = *arrow.vector3("from_m", metres);
    scene.to_m = arrow.required("to_m", arrow.vector3("to_m", metres));
  }
  return scene;
}

// Arrows of a key frame turn into those of the next one, so all keys need as many.
void check_keys_alike(const Table& surface, const WaterSurfaceScene& scene) {
  std::map<std::int64_t, int> count;
  for (const WaterArrowScene& a : scene.arrows) ++count[a.frame];
  for (const auto& [frame, arrows] : count) {
    if (arrows == count.begin()->second) continue;
    throw surface.error_at("arrow",
                           "has " + std::to_string(arrows) + " for frame " + std::to_string(frame) + " but " +
                               std::to_string(count.begin()->second) + " for frame " +
                               std::to_string(count.begin()->first),
                           "give every key frame as many arrows, in the same order");
  }
}

WaterSurfaceScene read_surface(const Table& surface) {
  WaterSurfaceScene scene;
  if (!surface.has("outline_m")) throw surface.missing("outline_m");
  scene.where = surface.where("outline_m");
  const auto outline = as_corners(*surface.find("outline_m"));
  if (!outline) throw surface.wrong("outline_m", "three corners [x, y, z] or more, in metres");
  scene.outline_m = *outline;
  if (const toml::Value* open = surface.find("open")) {
    const auto* array = std::get_if<toml::Array>(&open->held);
    for (std::size_t i = 0; array != nullptr && i < array->size(); ++i) {
      const auto* edge = std::get_if<std::int64_t>(&(*array)[i].held);
      if (edge == nullptr || *edge < 0 || *edge >= static_cast<std::int64_t>(outline->size())) {
        array = nullptr;
        break;
      }
      scene.open.push_back(static_cast<int>(*edge));
    }
    if (array == nullptr) {
      throw surface.wrong("open", "numbers of edges from 0 to " + std::to_string(outline->size() - 1));
    }
  }
  if (const toml::Value* obstacles = surface.find("obstacles_m")) {
    const auto* array = std::get_if<toml::Array>(&obstacles->held);
    if (array == nullptr) throw surface.wrong("obstacles_m", "a list of outlines, each of corners [x, y, z]");
    for (const toml::Value& element : *array) {
      const auto corners = as_corners(element);
      if (!corners) throw surface.wrong("obstacles_m", "a list of outlines, each of corners [x, y, z]");
      scene.obstacles_m.push_back(*corners);
    }
  }
  for (const Table& arrow : surface.tables("arrow")) {
    scene.arrows.push_back(read_arrow(arrow));
    scene.arrows.back().in_file = scene.arrows.size() - 1;
  }
  std::stable_sort(scene.arrows.begin(), scene.arrows.end(),
                   [](const WaterArrowScene& a, const WaterArrowScene& b) { return a.frame < b.frame; });
  check_keys_alike(surface, scene);
  scene.alpha_m = surface.number("alpha_m", Limits::above(0, 1e6));
  scene.colour = read_colour(surface, "colour");
  return scene;
}

WaterSprayScene read_spray(const Table& spray) {
  WaterSprayScene scene;
  scene.where = spray.where(spray.exactly_one({"from_m"}));
  scene.from_m = *spray.vector3("from_m", metres);
  scene.to_m = spray.required("to_m", spray.vector3("to_m", metres));
  scene.drops = static_cast<int>(spray.integer("drops", 1, 100'000).value_or(scene.drops));
  scene.height_m = spray.number("height_m", Limits::above(0, 1000)).value_or(scene.height_m);
  scene.size_m = spray.number("size_m", Limits::above(0, 1000)).value_or(scene.size_m);
  scene.colour = read_colour(spray, "colour").value_or(scene.colour);
  return scene;
}

WaterBrushScene read_brush(const Table& brush) {
  WaterBrushScene scene;
  scene.image = existing_file(brush, "image");
  const std::string_view at = brush.exactly_one({"at_px", "at_m"});
  scene.where = brush.where(at);
  scene.on_screen = at == "at_px";
  if (scene.on_screen) {
    scene.at_px = pixel(brush, "at_px");
  } else {
    scene.at_m = *brush.vector3("at_m", metres);
  }
  return scene;
}

void read_stroke(const Table& water, WaterScene& scene) {
  const auto stroke = water.table("stroke");
  if (!stroke) return;
  scene.length_m = stroke->number("length_m", Limits::above(0, 1e4));
  stroke->exclude("aspect", "width_px");
  scene.aspect = stroke->number("aspect", {0.02, 2}).value_or(scene.aspect);
  scene.width_px = stroke->number("width_px", Limits::above(0, 200));
  scene.opacity = stroke->number("opacity", Limits::above(0, 1)).value_or(scene.opacity);
  scene.ground = stroke->number("ground", {0, 1}).value_or(scene.ground);
  scene.foreshortening = stroke->number("foreshortening", {0, 1}).value_or(scene.foreshortening);
  scene.variety = stroke->number("variety", {0, 0.5}).value_or(scene.variety);
}

void read_mirror(const Table& water, WaterScene& scene) {
  const auto mirror = water.table("mirror");
  if (!mirror) return;
  scene.mirror_plate = mirror->flag("plate").value_or(scene.mirror_plate);
  scene.surroundings_m = mirror->number("surroundings_m", Limits::above(0, 1e6)).value_or(scene.surroundings_m);
  scene.reflection = mirror->number("reflection", {0, 1}).value_or(scene.reflection);
  scene.sky_zenith = read_colour(*mirror, "zenith").value_or(scene.sky_zenith);
  scene.sky_horizon = read_colour(*mirror, "horizon").value_or(scene.sky_horizon);
  if (!mirror->has("panorama")) return;
  for (const std::string_view key : {"zenith", "horizon"}) mirror->exclude("panorama", key);
  scene.panorama = existing_file(*mirror, "panorama");
}

}  // namespace

toml::Schema water_schema() {
  return {
      {.path = "water",
       .keys = {"strokes", "layers", "colour", "stroke", "flow", "mirror", "colours", "waterline", "surface", "spray",
                "brush"}},
      {.path = "water.stroke",
       .keys = {"length_m", "aspect", "width_px", "opacity", "ground", "foreshortening", "variety"}},
      {.path = "water.flow", .keys = {"method", "alpha_m", "cells"}},
      {.path = "water.mirror", .keys = {"plate", "surroundings_m", "reflection", "zenith", "horizon", "panorama"}},
      {.path = "water.colours", .keys = {"method", "key_frames", "ripple", "mean"}},
      {.path = "water.waterline", .keys = {"colour"}},
      {.path = "water.surface",
       .keys = {"outline_m", "open", "obstacles_m", "alpha_m", "colour", "arrow"},
       .repeated = true},
      {.path = "water.surface.arrow", .keys = {"frame", "from_px", "to_px", "from_m", "to_m"}, .repeated = true},
      {.path = "water.spray", .keys = {"from_m", "to_m", "drops", "height_m", "size_m", "colour"}, .repeated = true},
      {.path = "water.brush", .keys = {"image", "at_px", "at_m"}, .repeated = true},
  };
}

WaterScene read_water(const Table& water) {
  WaterScene scene;
  scene.where = water.where(water.exactly_one({"surface"}));
  scene.strokes = static_cast<int>(water.integer("strokes", 1, 1'000'000).value_or(scene.strokes));
  scene.layers = water.number("layers", Limits::above(0, 100)).value_or(scene.layers);
  scene.colour = read_colour(water, "colour").value_or(scene.colour);
  read_stroke(water, scene);
  if (const auto flow = water.table("flow")) {
    scene.flow = read_choice<WaterScene::Flow>(
                     *flow, "method",
                     {{"divergence_free", WaterScene::Flow::DivergenceFree}, {"arrows", WaterScene::Flow::Arrows}})
                     .value_or(scene.flow);
    scene.alpha_m = flow->number("alpha_m", Limits::above(0, 1e6));
    scene.cells = static_cast<int>(flow->integer("cells", 4, 96).value_or(scene.cells));
  }
  read_mirror(water, scene);
  if (const auto colours = water.table("colours")) {
    scene.colours = read_choice<WaterScene::Colours>(*colours, "method",
                                                     {{"keys", WaterScene::Colours::Keys},
                                                      {"followed", WaterScene::Colours::Followed},
                                                      {"sampled", WaterScene::Colours::Sampled}})
                        .value_or(scene.colours);
    scene.key_frames = static_cast<int>(colours->integer("key_frames", 1, 120).value_or(scene.key_frames));
    scene.mean = colours->flag("mean").value_or(scene.mean);
    scene.ripple = colours->number("ripple", {0, 10}).value_or(scene.ripple);
  }
  if (const auto waterline = water.table_unless_flag("waterline")) {
    scene.waterline_colour = read_colour(*waterline, "colour").value_or(scene.waterline_colour);
  } else if (water.has("waterline")) {
    scene.waterline = *water.flag("waterline");
  }
  for (const Table& surface : water.tables("surface")) scene.surfaces.push_back(read_surface(surface));
  for (const Table& spray : water.tables("spray")) scene.sprays.push_back(read_spray(spray));
  for (const Table& brush : water.tables("brush")) scene.brushes.push_back(read_brush(brush));
  if (scene.brushes.size() > 4) throw water.error_at("brush", "is given more than four times", "leave some out");
  return scene;
}

bool paints_the_same(WaterScene a, WaterScene b) {
  for (WaterScene* water : {&a, &b}) {
    water->where.clear();
    for (WaterSurfaceScene& surface : water->surfaces) {
      surface.where.clear();
      for (WaterArrowScene& arrow : surface.arrows) arrow.where.clear(), arrow.in_file = 0;
    }
    for (WaterSprayScene& spray : water->sprays) spray.where.clear();
    for (WaterBrushScene& brush : water->brushes) brush.where.clear();
  }
  return a == b;
}

}  // namespace rinkaku::pipeline
