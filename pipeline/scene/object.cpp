#include "pipeline/scene/object.h"

#include <cmath>
#include <cstdint>
#include <string_view>
#include <variant>

#include "pipeline/scene/values.h"

namespace rinkaku::pipeline {
namespace {

using toml::Limits;
using toml::Table;

// Of a mesh's size: beyond these a value is a slip of the pen.
constexpr double smallest_scale = 1e-6, largest_scale = 1e6;

/// Three factors, none of them 0; negative ones mirror.
glm::dvec3 read_scale(const Table& object) {
  const toml::Value& value = *object.find("scale");
  const bool three = std::holds_alternative<toml::Array>(value.held);
  const bool one = std::holds_alternative<double>(value.held) || std::holds_alternative<std::int64_t>(value.held);
  if (!one && !three) throw object.wrong("scale", "a number or three numbers [x, y, z]");
  const Limits limits{-largest_scale, largest_scale};
  const glm::dvec3 scale = three ? *object.vector3("scale", limits) : glm::dvec3(*object.number("scale", limits));
  for (int i = 0; i < 3; ++i) {
    if (std::abs(scale[i]) < smallest_scale) throw object.error_at("scale", "must not be 0 or nearly 0");
  }
  return scale;
}

/// What is made of a mesh at rest can't go with it when it moves.
void refuse_for_animated(const Table& object, const ObjectScene& scene) {
  if (!scene.animation) return;
  if (object.has("regions")) {
    throw object.error_at("regions", "needs a mesh that stands still, but the object has 'animation'",
                          "leave one of them out");
  }
  using Cut = FluffyScene::Cut;
  if (scene.fluffy && (scene.fluffy->cut == Cut::Regions || scene.fluffy->cut == Cut::Nearest)) {
    throw object.error_at("fluffy", "is cut by lists made of a mesh that stands still, but the object has 'animation'",
                          "give cut = \"exact\" or \"gpu\"");
  }
}

}  // namespace

bool has_coarse_colour(const ObjectScene& object) {
  return object.shading_scale > 1 && (object.toon || !object.colour);
}

toml::Schema object_schema() {
  toml::Schema schema = {
      {.path = "object",
       .keys = {"mesh", "name", "position_m", "rotation_deg", "height_m", "scale", "up", "anchor", "crease_deg",
                "colour", "animation", "toon", "outline", "fluffy", "holdout", "regions", "shading_scale"},
       .repeated = true}};
  // What an object is drawn with; a new pass adds its line here.
  for (const toml::Schema& pass : {animation_schema(), toon_schema(), outline_schema(), fluffy_schema()}) {
    schema.insert(schema.end(), pass.begin(), pass.end());
  }
  return schema;
}

ObjectScene read_object(const Table& object) {
  ObjectScene scene;
  scene.mesh = existing_file(object, "mesh");
  scene.name = object.text("name").value_or(scene.mesh.filename().string());
  scene.position_m = object.vector3("position_m", metres).value_or(scene.position_m);
  scene.rotation_deg = object.vector3("rotation_deg", {-1e6, 1e6}).value_or(scene.rotation_deg);
  object.exclude("height_m", "scale");
  scene.height_m = object.number("height_m", Limits::above(0, 1e6));
  if (object.has("scale")) scene.scale = read_scale(object);
  if (const auto up = object.text("up")) {
    if (*up != "x" && *up != "y" && *up != "z") throw object.wrong("up", "\"x\", \"y\" or \"z\"");
    scene.up = up->front();
  }
  // Who gives a scale means the mesh's own coordinates.
  const std::string anchor = object.text("anchor").value_or(object.has("scale") ? "origin" : "base");
  if (anchor != "base" && anchor != "origin") throw object.wrong("anchor", "\"base\" or \"origin\"");
  scene.anchor = anchor == "base" ? ObjectScene::Anchor::Base : ObjectScene::Anchor::Origin;
  scene.crease_deg = object.number("crease_deg", {0, 180}).value_or(scene.crease_deg);
  scene.colour = read_colour(object, "colour");
  scene.regions = read_regions(object);
  scene.animation = read_animation(object);
  scene.holdout = object.flag("holdout").value_or(false);
  refuse_for_animated(object, scene);
  if (scene.holdout) {
    for (const std::string_view key : {"colour", "toon", "outline", "fluffy", "shading_scale"}) {
      if (object.has(key))
        throw object.error_at(key, "has no meaning for a holdout, which is not drawn", "leave it out");
    }
    return scene;
  }
  scene.toon = read_toon(object);
  scene.shading_scale = static_cast<int>(object.integer("shading_scale", 1, 4).value_or(scene.shading_scale));
  scene.outline = read_outline(object);
  scene.fluffy = read_fluffy(object, scene.outline);
  refuse_for_animated(object, scene);
  return scene;
}

}  // namespace rinkaku::pipeline
