#include "silhouette/region_cache.h"

#include <cstdlib>
#include <sstream>
#include <string>
#include <system_error>

#include <xxhash.h>

#include "pipeline/files/pending_file.h"
#include "pipeline/frame/error.h"

namespace rinkaku::silhouette {
namespace {

namespace fs = std::filesystem;

/// An absolute folder from the environment; relative ones are to be ignored (XDG Base Directory Specification).
fs::path folder_from(const char* variable) {
  const char* value = std::getenv(variable);
  fs::path folder = value ? fs::path(value) : fs::path();
  return folder.is_absolute() ? folder : fs::path();
}

/// Everything but the surface that a file's contents depend on.
std::uint64_t hash_of(const BakeOptions& options) {
  std::vector<double> values{options.reduce.depth_distance, options.reduce.drop_hidden ? 1.0 : 0.0};
  if (const auto* layout = std::get_if<RegionLayout>(&options.space)) {
    values.insert(values.end(), {0.0, double(layout->cells), double(layout->shells), layout->inner_radii});
  } else {
    values.push_back(1.0);
    for (const glm::dvec4& h : std::get<ViewRegion>(options.space).hull)
      values.insert(values.end(), {h.x, h.y, h.z, h.w});
  }
  return XXH3_64bits(values.data(), values.size() * sizeof(double));
}

bool same_space(const ViewSpace& a, const ViewSpace& b) {
  if (a.index() != b.index()) return false;
  if (const auto* layout = std::get_if<RegionLayout>(&a)) return *layout == std::get<RegionLayout>(b);
  return std::get<ViewRegion>(a).hull == std::get<ViewRegion>(b).hull;
}

}  // namespace

fs::path region_cache_folder() {
  fs::path cache = folder_from("XDG_CACHE_HOME");
  if (cache.empty()) {
    cache = folder_from("HOME");
    if (cache.empty()) return {};
    cache /= ".cache";
  }
  return cache / "rinkaku" / "regions";
}

fs::path cached_region_file(const Surface& surface, const BakeOptions& options) {
  const fs::path folder = region_cache_folder();
  if (folder.empty()) return {};
  // Lists that other rules chose are other lists.
  constexpr int rules = 2;
  std::ostringstream name;
  name << std::hex << surface.hash << '-' << hash_of(options) << "-v" << std::dec << RegionFile::kVersion << '.'
       << rules << ".rgn";
  return folder / name.str();
}

std::optional<RegionFile> find_cached_regions(const Surface& surface, const BakeOptions& options) {
  const fs::path path = cached_region_file(surface, options);
  std::error_code ignored;
  if (path.empty() || !fs::exists(path, ignored)) return std::nullopt;
  try {
    RegionFile file = RegionFile::open(path);
    file.must_belong_to(surface);
    if (!same_space(file.space(), options.space) || file.depth_distance() != options.reduce.depth_distance) {
      return std::nullopt;
    }
    return file;
  } catch (const Error&) {
    return std::nullopt;  // baked anew, and written over
  }
}

std::optional<RegionFile> cached_regions(const Surface& surface, const BakeOptions& options,
                                         const std::function<void(std::uint32_t done, std::uint32_t total)>& progress,
                                         const std::atomic<bool>* stop) {
  if (auto found = find_cached_regions(surface, options)) return found;
  auto baked = bake(surface, options, progress, stop);
  if (!baked) return std::nullopt;
  const fs::path path = cached_region_file(surface, options);
  if (!path.empty()) {
    std::error_code ignored;
    fs::create_directories(path.parent_path(), ignored);
    try {
      files::PendingFile(path.string(), true).write(baked->file);
    } catch (const Error&) {
      // Nobody asked for the file: without one, the next run bakes again.
    }
  }
  return RegionFile::from_memory(std::move(baked->file), path.empty() ? "regions" : path.string());
}

}  // namespace rinkaku::silhouette
