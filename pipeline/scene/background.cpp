#include "pipeline/scene/background.h"

#include "pipeline/scene/values.h"

namespace rinkaku::pipeline {

toml::Schema background_schema() { return {{.path = "background", .keys = {"colour", "image", "video", "images"}}}; }

BackgroundScene read_background(const toml::Table& background) {
  BackgroundScene scene;
  const std::string_view from = background.exactly_one({"colour", "image", "video", "images"});
  if (from == "colour") {
    scene.colour = read_colour(background, from);
  } else if (from == "images") {
    scene.is_sequence = true;
    scene.input = image_pattern(background, from, "%*?[", "world/%04d.png");
  } else {
    scene.input = existing_file(background, from).string();
  }
  return scene;
}

}  // namespace rinkaku::pipeline
