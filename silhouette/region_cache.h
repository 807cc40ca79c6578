#pragma once

#include <filesystem>
#include <optional>

#include "silhouette/bake.h"
#include "silhouette/region_file.h"

namespace rinkaku::silhouette {

/// Where files baked on first use are kept: $XDG_CACHE_HOME/rinkaku/regions, or ~/.cache/rinkaku/regions. Empty if
/// neither variable names an absolute folder.
std::filesystem::path region_cache_folder();

/// A surface's file in the cache, named after its hash, the view space, the options and the file's version.
std::filesystem::path cached_region_file(const Surface& surface, const BakeOptions& options);

/// The surface's file from the cache, if it is there and sound. A damaged or foreign file counts as none.
std::optional<RegionFile> find_cached_regions(const Surface& surface, const BakeOptions& options);

/// The surface's regions: from the cache, else baked now and kept there. If the cache can't be written to, they are
/// used from memory. Nothing is returned if `stop` was set. Arguments as bake(); its `progress` is called only if it
/// bakes.
std::optional<RegionFile> cached_regions(
    const Surface& surface, const BakeOptions& options = {},
    const std::function<void(std::uint32_t done, std::uint32_t total)>& progress = {},
    const std::atomic<bool>* stop = nullptr);

}  // namespace rinkaku::silhouette
