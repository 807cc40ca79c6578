#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "pipeline/matte/chroma.h"
#include "pipeline/matte/difference.h"
#include "pipeline/matte/foreground.h"
#include "pipeline/toml/table.h"

namespace rinkaku::pipeline {

/// How a filmed thing's matte is found.
struct DifferenceMatteScene {
  std::string clean;  ///< a picture of the empty scene; empty: it is learnt
  matte::DifferenceOptions options;
};
struct FileMatteScene {
  std::string input;  ///< video or image sequence
};
struct SegmentationScene {
  std::string model;  ///< empty: the one that scripts/fetch-model installs
};

/// [[foreground]]: a filmed thing that CG can be behind.
struct ForegroundScene {
  std::string name;
  using Method = std::variant<matte::ChromaOptions, DifferenceMatteScene, FileMatteScene, SegmentationScene>;
  std::vector<Method> methods;
  matte::ForegroundOptions options;
  /// How far away it is, along the camera's axis; empty: it stands on the ground, or nothing depends on it.
  std::optional<double> distance_m;
  bool on_ground = false;
};

toml::Schema foreground_schema();

/// Throws Error (Input).
ForegroundScene read_foreground(const toml::Table& foreground);

}  // namespace rinkaku::pipeline
