#pragma once

#include <array>
#include <optional>

#include "pipeline/toml/table.h"

namespace rinkaku::pipeline {

/// toon of [[object]]: shading in bands.
struct ToonScene {
  int bands = 3;
  std::array<double, 3> shade_colour{0.62, 0.60, 0.78};  ///< sRGB; what the darkest band multiplies the colour by
};

toml::Schema toon_schema();

/// Empty for `toon = false`. Throws Error (Input).
std::optional<ToonScene> read_toon(const toml::Table& object);

}  // namespace rinkaku::pipeline
