#include "silhouette/region_cache.h"

#include <fstream>

#include <gtest/gtest.h>

#include "tests/silhouette/surfaces.h"
#include "tests/support/environment.h"

namespace rinkaku::silhouette {
namespace {

using test::Environment;
using test::surface_of;

BakeOptions small() {
  BakeOptions options;
  options.space = RegionLayout{1, 1, 1.5};
  return options;
}

struct Counted {
  std::optional<RegionFile> file;
  int regions_baked = 0;
};
Counted get(const Surface& surface, const BakeOptions& options = small()) {
  Counted out;
  out.file = cached_regions(surface, options, [&](std::uint32_t, std::uint32_t) { ++out.regions_baked; });
  return out;
}

TEST(RegionCache, BakesOnFirstUseOnly) {
  const test::TemporaryFolder folder;
  const Environment cache("XDG_CACHE_HOME", folder.path().string());
  const Surface surface = surface_of(test::sphere(2));
  EXPECT_FALSE(find_cached_regions(surface, small()));
  EXPECT_EQ(get(surface).regions_baked, 6);
  EXPECT_EQ(get(surface).regions_baked, 0);
  EXPECT_TRUE(find_cached_regions(surface, small()));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "rinkaku" / "regions"));
}

TEST(RegionCache, OtherMeshesAndOptionsHaveFilesOfTheirOwn) {
  const test::TemporaryFolder folder;
  const Environment cache("XDG_CACHE_HOME", folder.path().string());
  BakeOptions finer = small();
  finer.space = RegionLayout{2, 1, 1.5};
  BakeOptions deep = small();
  deep.reduce.depth_distance = 0.01;
  const Surface surface = surface_of(test::sphere(2));
  EXPECT_EQ(get(surface).regions_baked, 6);
  EXPECT_EQ(get(surface, finer).regions_baked, 24);
  EXPECT_EQ(get(surface, deep).regions_baked, 6);
  EXPECT_EQ(get(surface_of(test::sphere(1))).regions_baked, 6);
  EXPECT_EQ(get(surface).regions_baked, 0);
  EXPECT_TRUE(get(surface, deep).file->has_depth());
}

TEST(RegionCache, DamagedFileIsBakedAnew) {
  const test::TemporaryFolder folder;
  const Environment cache("XDG_CACHE_HOME", folder.path().string());
  const Surface surface = surface_of(test::sphere(2));
  get(surface);
  std::ofstream(cached_region_file(surface, small())) << "not a region file";
  EXPECT_EQ(get(surface).regions_baked, 6);
  EXPECT_EQ(get(surface).regions_baked, 0);
}

TEST(RegionCache, WorksFromMemoryWhereNothingCanBeKept) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "file") << "in the way";
  const Environment cache("XDG_CACHE_HOME", (folder / "file").string());
  const Counted got = get(surface_of(test::sphere(2)));
  ASSERT_TRUE(got.file);
  EXPECT_EQ(got.file->regions(), 6u);
}

TEST(RegionCache, FolderFollowsTheEnvironment) {
  const Environment home("HOME", "/home/someone");
  {
    const Environment cache("XDG_CACHE_HOME", "/var/cache/x");
    EXPECT_EQ(region_cache_folder(), "/var/cache/x/rinkaku/regions");
  }
  const Environment relative("XDG_CACHE_HOME", "not/absolute");
  EXPECT_EQ(region_cache_folder(), "/home/someone/.cache/rinkaku/regions");
}

}  // namespace
}  // namespace rinkaku::silhouette
