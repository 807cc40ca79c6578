#include "silhouette/bake.h"

#include <gtest/gtest.h>

#include "pipeline/frame/error.h"
#include "tests/silhouette/surfaces.h"

namespace rinkaku::silhouette {
namespace {

using test::surface_of;

BakeOptions small() {
  BakeOptions options;
  options.space = RegionLayout{2, 2, 1.5};
  options.reduce.depth_distance = 0.01;
  return options;
}

TEST(Bake, FileIsTheSameForAnyNumberOfThreads) {
  const Surface surface = surface_of(test::wavy_sphere(4));
  BakeOptions options = small();
  options.threads = 1;
  const auto one = bake(surface, options);
  options.threads = 5;
  const auto five = bake(surface, options);
  ASSERT_TRUE(one && five);
  EXPECT_EQ(one->file, five->file);
  EXPECT_EQ(one->report.mean_ratio, five->report.mean_ratio);
}

TEST(Bake, ReportTellsWhatIsInTheFile) {
  const Surface surface = surface_of(test::wavy_sphere(4));
  const auto baked = bake(surface, small());
  ASSERT_TRUE(baked);
  const BakeReport& report = baked->report;
  EXPECT_EQ(report.regions, 48u);
  EXPECT_EQ(report.bytes, baked->file.size());
  EXPECT_EQ(report.triangles_full, 2048u);
  EXPECT_GT(report.mean_ratio, 0.2);
  EXPECT_LE(report.mean_ratio, report.max_ratio);
  EXPECT_LT(report.max_ratio, 0.8);
}

TEST(Bake, ProgressCountsEachRegionOnce) {
  std::vector<std::uint32_t> calls;
  bake(surface_of(test::sphere(2)), small(), [&](std::uint32_t done, std::uint32_t total) {
    EXPECT_EQ(total, 48u);
    calls.push_back(done);
  });
  ASSERT_EQ(calls.size(), 48u);
  for (std::uint32_t i = 0; i < calls.size(); ++i) EXPECT_EQ(calls[i], i + 1);
}

TEST(Bake, StopsWithinARegionAndLeavesNothing) {
  std::atomic<bool> stop{false};
  std::uint32_t calls = 0;
  BakeOptions options = small();
  options.threads = 2;
  const auto baked = bake(
      surface_of(test::sphere(3)), options,
      [&](std::uint32_t done, std::uint32_t) {
        calls = done;
        if (done == 3) stop = true;
      },
      &stop);
  EXPECT_FALSE(baked);
  EXPECT_LE(calls, 3u + 1u) << "the other thread may have been in a region";
}

TEST(Bake, ThrowingProgressEndsIt) {
  EXPECT_THROW(bake(surface_of(test::sphere(2)), small(), [](std::uint32_t, std::uint32_t) { throw 1; }), int);
}

TEST(Bake, BadOptionsAreRefused) {
  const Surface surface = surface_of(test::sphere(1));
  BakeOptions options;
  options.space = RegionLayout{0, 1, 1.5};
  EXPECT_THROW(bake(surface, options), Error);
  options = {};
  options.reduce.depth_distance = -1;
  EXPECT_THROW(bake(surface, options), Error);
}

}  // namespace
}  // namespace rinkaku::silhouette
