#include "pipeline/scene/scene.h"

#include "pipeline/frame/error.h"
#include "pipeline/toml/table.h"

namespace rinkaku::pipeline {
namespace {

namespace fs = std::filesystem;

toml::Schema scene_schema() {
  toml::Schema schema = {{.path = "", .keys = {"plate", "track", "light", "object", "output"}}};
  for (const toml::Schema& section :
       {plate_schema(), track_schema(), light_schema(), object_schema(), output_schema()}) {
    schema.insert(schema.end(), section.begin(), section.end());
  }
  return schema;
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
  for (const toml::Table& object : root.tables("object")) {
    if (!scene.track) {
      throw object.error("[[object]] needs a camera pose", "add [track] with one of marker, board, poses, locked");
    }
    if (scene.plate.camera.empty()) {
      throw object.error("[[object]] needs the camera's intrinsics", "add 'camera' to [plate], e.g. \"camera.yml\"");
    }
    scene.objects.push_back(read_object(object));
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
