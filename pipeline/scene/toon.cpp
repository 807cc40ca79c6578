#include "pipeline/scene/toon.h"

#include "pipeline/scene/values.h"

namespace rinkaku::pipeline {

toml::Schema toon_schema() { return {{.path = "object.toon", .keys = {"bands", "shade_colour"}}}; }

std::optional<ToonScene> read_toon(const toml::Table& object) {
  ToonScene scene;
  if (const auto toon = object.table_unless_flag("toon")) {
    scene.bands = static_cast<int>(toon->integer("bands", 2, 16).value_or(scene.bands));
    scene.shade_colour = read_colour(*toon, "shade_colour").value_or(scene.shade_colour);
  } else if (object.has("toon") && !*object.flag("toon")) {
    return std::nullopt;
  }
  return scene;
}

}  // namespace rinkaku::pipeline
