#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "pipeline/frame/picture_format.h"
#include "pipeline/toml/table.h"

namespace rinkaku::pipeline {

/// [plate]: the filmed picture.
struct PlateScene {
  std::string input;             ///< video file or image sequence pattern; absolute
  std::optional<Rational> fps;   ///< of an image sequence
  std::filesystem::path camera;  ///< camera.yml; empty if there is none (then nothing can be drawn)
};

toml::Schema plate_schema();

/// `input` takes the place of the plate's own video or images if it isn't empty. Throws Error (Input).
PlateScene read_plate(const toml::Table& plate, const std::string& input);

}  // namespace rinkaku::pipeline
