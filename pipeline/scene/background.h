#pragma once

#include <array>
#include <optional>
#include <string>

#include "pipeline/toml/table.h"

namespace rinkaku::pipeline {

/// [background]: what stands in the plate's place behind the filmed things.
struct BackgroundScene {
  std::optional<std::array<double, 3>> colour;  ///< sRGB
  bool is_sequence = false;                     ///< `input` is a pattern
  std::string input;                            ///< a picture, video or image sequence; empty if a colour is given
};

toml::Schema background_schema();

/// Throws Error (Input).
BackgroundScene read_background(const toml::Table& background);

}  // namespace rinkaku::pipeline
