#include "pipeline/scene/fluffy.h"

#include <string_view>
#include <variant>

#include "pipeline/scene/values.h"

namespace rinkaku::pipeline {
namespace {

using fluffy::Coordinates;
using fluffy::FurKind;
using fluffy::Growth;
using toml::Limits;
using toml::Table;

void read_texture(const Table& fluffy, FluffyScene& scene) {
  if (const auto texture = fluffy.text("texture")) {
    const auto made = *texture == "fur"    ? std::optional(FurKind::Fur)
                      : *texture == "wool" ? std::optional(FurKind::Wool)
                      : *texture == "down" ? std::optional(FurKind::Down)
                                           : std::nullopt;
    scene.made_texture = made;
    if (!made) scene.texture = existing_file(fluffy, "texture");
  }
  scene.threshold = fluffy.number("threshold", {0, 1}).value_or(scene.threshold);
  using Keep = FluffyScene::Keep;
  scene.keep = read_choice<Keep>(fluffy, "keep", {{"above", Keep::Above}, {"below", Keep::Below}}).value_or(scene.keep);
}

// One name or several.
std::vector<std::string> read_names(const Table& fluffy, std::string_view key) {
  const toml::Value* value = fluffy.find(key);
  if (value == nullptr) return {};
  if (!std::holds_alternative<toml::Array>(value->held)) return {*fluffy.text(key)};
  std::vector<std::string> names;
  for (const toml::Value& one : std::get<toml::Array>(value->held)) {
    const auto* name = std::get_if<std::string>(&one.held);
    if (name == nullptr || name->empty()) throw fluffy.wrong(key, "a name or an array of names");
    names.push_back(*name);
  }
  if (names.empty()) throw fluffy.error_at(key, "names nothing", "leave it out for the whole mesh");
  return names;
}

void read_frame(const Table& fluffy, fluffy::FrameOptions& frame) {
  frame.selection.names = read_names(fluffy, "parts");
  frame.selection.painted_channel =
      read_choice<int>(fluffy, "vertex_paint", {{"red", 0}, {"green", 1}, {"blue", 2}, {"alpha", 3}}).value_or(-1);
  frame.growth = read_choice<Growth>(fluffy, "mode", {{"normals", Growth::AlongNormals}, {"scaled", Growth::Scaled}})
                     .value_or(frame.growth);
  fluffy.exclude("scale", "length_m");
  frame.scale = fluffy.number("scale", Limits::above(1, 3)).value_or(frame.scale);
  frame.length_m = fluffy.number("length_m", Limits::above(0, 1000));
  if (frame.length_m && frame.growth == Growth::Scaled) {
    throw fluffy.error_at("length_m", "goes with mode = \"normals\"", "give 'scale' instead");
  }
  frame.exaggeration = fluffy.number("exaggeration", {0, 20}).value_or(frame.exaggeration);
}

void read_coordinates(const Table& fluffy, FluffyScene& scene) {
  // Tufts of our own textures shall be equally large everywhere; a picture was mostly made for the mesh.
  scene.mesh_coordinates_if_any = !scene.made_texture;
  if (const auto given = read_choice<Coordinates>(
          fluffy, "coordinates", {{"mesh", Coordinates::Mesh}, {"generated", Coordinates::Generated}})) {
    scene.frame.coordinates = *given;
    scene.mesh_coordinates_if_any = false;
  }
  scene.frame.tile_m = fluffy.number("tile_m", Limits::above(0, 1e6));
  scene.frame.repeat = fluffy.number("repeat", Limits::above(0, 1000)).value_or(scene.frame.repeat);
  const bool generated = scene.frame.coordinates == Coordinates::Generated && !scene.mesh_coordinates_if_any;
  if (scene.frame.tile_m && !generated) {
    throw fluffy.error_at("tile_m", "goes with coordinates = \"generated\"", "add that, or give 'repeat'");
  }
  if (fluffy.has("repeat") && generated) {
    throw fluffy.error_at("repeat", "goes with coordinates = \"mesh\"", "add that, or give 'tile_m'");
  }
}

void read_paint(const Table& fluffy, FluffyScene& scene) {
  using Paint = FluffyScene::Paint;
  if (!scene.made_texture) scene.paint = Paint::Texture;
  if (!fluffy.has("colour")) return;
  const toml::Value& value = *fluffy.find("colour");
  const auto* word = std::get_if<std::string>(&value.held);
  if (word != nullptr && *word == "body") {
    scene.paint = Paint::Body;
  } else if (word != nullptr && *word == "texture") {
    scene.paint = Paint::Texture;
  } else {
    scene.paint = Paint::Own;
    scene.colour = *read_colour(fluffy, "colour");
  }
}

}  // namespace

toml::Schema fluffy_schema() {
  return {
      {.path = "object.fluffy",
       .keys = {"texture", "threshold", "keep", "parts", "vertex_paint", "mode", "scale", "length_m", "exaggeration",
                "coordinates", "tile_m", "repeat", "angle_deg", "layers", "colour", "hang", "line", "cut"}}};
}

std::optional<FluffyScene> read_fluffy(const Table& object, bool outlined) {
  const auto fluffy = object.table_unless_flag("fluffy");
  if (!fluffy && (!object.has("fluffy") || !*object.flag("fluffy"))) return std::nullopt;
  FluffyScene scene;
  scene.where = object.where("fluffy") + ": fluffy";
  if (!fluffy) return scene;
  read_texture(*fluffy, scene);
  read_frame(*fluffy, scene.frame);
  read_coordinates(*fluffy, scene);
  read_paint(*fluffy, scene);
  scene.angle_deg = fluffy->number("angle_deg", {1, 179}).value_or(scene.angle_deg);
  scene.layers = static_cast<int>(fluffy->integer("layers", 1, 64).value_or(scene.layers));
  scene.hang = fluffy->number("hang", {0, 2}).value_or(scene.hang);
  using Line = FluffyScene::Line;
  scene.line = read_choice<Line>(*fluffy, "line", {{"rim", Line::Rim}, {"body", Line::Body}, {"none", Line::None}})
                   .value_or(scene.line);
  if (fluffy->has("line") && !outlined) {
    throw fluffy->error_at("line", "says where the outline runs, and the object has none", "add 'outline' to it");
  }
  using Cut = FluffyScene::Cut;
  scene.cut = read_choice<Cut>(
                  *fluffy, "cut",
                  {{"exact", Cut::Exact}, {"regions", Cut::Regions}, {"nearest", Cut::Nearest}, {"none", Cut::None}})
                  .value_or(scene.cut);
  return scene;
}

}  // namespace rinkaku::pipeline
