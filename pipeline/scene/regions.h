#pragma once

#include <filesystem>
#include <optional>

#include "pipeline/toml/table.h"

namespace rinkaku::pipeline {

/// regions of [[object]]: lists baked for every view region, see silhouette/.
struct RegionsScene {
  std::filesystem::path file;  ///< absolute; empty: baked on first use, and kept in the cache
};

/// Empty if there is none, or for `regions = false`. Throws Error (Input).
std::optional<RegionsScene> read_regions(const toml::Table& object);

}  // namespace rinkaku::pipeline
