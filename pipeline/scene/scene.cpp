#include "pipeline/scene/scene.h"

#include "pipeline/frame/error.h"
#include "pipeline/toml/table.h"

namespace rinkaku::pipeline {
namespace {

namespace fs = std::filesystem;

toml::Schema scene_schema() {
  toml::Schema schema = {
      {.path = "", .keys = {"plate", "track", "light", "background", "foreground", "object", "water", "output"}}};
  for (const toml::Schema& section : {plate_schema(), track_schema(), light_schema(), background_schema(),
                                      foreground_schema(), object_schema(), water_schema(), output_schema()}) {
    schema.insert(schema.end(), section.begin(), section.end());
  }
  return schema;
}

/// What is drawn needs to know how the plate was filmed.
void require_camera(const Scene& scene, const toml::Table& drawn, const std::string& section) {
  if (!scene.track) {
    throw drawn.error(section + " needs a camera pose", "add [track] with one of marker, board, poses, locked");
  }
  if (scene.plate.camera.empty()) {
    throw drawn.error(section + " needs the camera's intrinsics", "add 'camera' to [plate], e.g. \"camera.yml\"");
  }
}

Scene read(const toml::Document& document, const SceneOptions& options) {
  const toml::Table root = document.root();
  const std::string file = document.file().string();
  Scene scene;
  scene.file = fs::absolute(document.file()).lexically_normal();
  if (document.empty()) {
    throw input_error(file, "the scene is empty", "it needs at least [plate] with 'video', 'images' or 'device'");
  }
  if (!root.has("plate")) throw input_error(file, "[plate] is missing", "add it, with 'video', 'images' or 'device'");
  scene.plate = read_plate(*root.table("plate"), {options.input, options.device});
  if (const auto track = root.table("track")) scene.track = read_track(*track);
  if (const auto light = root.table("light")) scene.light = read_light(*light);
  for (const toml::Table& table : root.tables("foreground")) {
    scene.foregrounds.push_back(read_foreground(table));
    const ForegroundScene& foreground = scene.foregrounds.back();
    if (foreground.on_ground && (!scene.track || scene.plate.camera.empty())) {
      throw table.error_at("on_ground", "needs to know where the camera is", "add [track], and 'camera' to [plate]");
    }
    if (!foreground.on_ground && !foreground.distance_m && root.has("object")) {
      throw table.error("[[foreground]] must say how far away it is, so that CG goes before or behind it",
                        "add distance_m = METRES, or on_ground = true if it stands on the world's z = 0");
    }
  }
  if (const auto background = root.table("background")) {
    if (scene.foregrounds.empty()) {
      throw background->error("[background] needs a [[foreground]]: nothing of the plate would be left",
                              "add one with the matte of what is to be kept");
    }
    scene.background = read_background(*background);
  }
  for (const toml::Table& object : root.tables("object")) {
    require_camera(scene, object, "[[object]]");
    scene.objects.push_back(read_object(object));
  }
  if (const auto water = root.table("water")) {
    require_camera(scene, *water, "[water]");
    scene.water = read_water(*water);
  }
  if (const auto output = root.table("output")) {
    scene.output = read_output(*output);
    if (!scene.output.path.empty() && scene.output.path == scene.plate.input) {
      throw output->error_at(output->has("video") ? "video" : "images", "is the filmed input itself",
                             "name another file");
    }
  }
  return scene;
}

}  // namespace

Scene read_scene(const fs::path& file, const SceneOptions& options) {
  if (options.text) {
    const toml::Document document(file, scene_schema(), *options.text);
    return read(document, options);
  }
  const toml::Document document(file, scene_schema());
  return read(document, options);
}

}  // namespace rinkaku::pipeline
