#pragma once

#include <glm/vec3.hpp>

#include "pipeline/toml/table.h"

namespace rinkaku::pipeline {

/// [light]
struct LightScene {
  glm::dvec3 direction{-0.4, 0.5, 0.8};  ///< towards the light, in the world
};

toml::Schema light_schema();

/// Throws Error (Input).
LightScene read_light(const toml::Table& light);

}  // namespace rinkaku::pipeline
