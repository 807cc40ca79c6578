#include "pipeline/scene/light.h"

#include <glm/geometric.hpp>

#include "pipeline/scene/values.h"

namespace rinkaku::pipeline {

toml::Schema light_schema() { return {{.path = "light", .keys = {"direction"}}}; }

LightScene read_light(const toml::Table& light) {
  LightScene scene;
  scene.direction = light.vector3("direction", metres).value_or(scene.direction);
  if (!(glm::length(scene.direction) > 1e-9)) {
    throw light.error_at("direction", "must not be [0, 0, 0]", "give the way towards the light");
  }
  return scene;
}

}  // namespace rinkaku::pipeline
