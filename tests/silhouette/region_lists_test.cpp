#include "silhouette/region_lists.h"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "pipeline/frame/error.h"
#include "silhouette/bake.h"
#include "tests/silhouette/surfaces.h"

namespace rinkaku::silhouette {
namespace {

using test::surface_of;

/// Eyes go round the object through the middle of a row of regions, so that no corner is cut.
struct Baked4 {
  Surface surface = surface_of(test::wavy_sphere(4));
  std::shared_ptr<const RegionFile> file;
  Baked4() {
    BakeOptions options;
    options.space = RegionLayout{4, 1, 1.5};
    file = std::make_shared<const RegionFile>(RegionFile::from_memory(bake(surface, options)->file, "baked"));
  }
  glm::dvec3 eye(double angle, double distance = 3) const {
    return surface.frame.to_mesh(distance * glm::dvec3(std::cos(angle), std::sin(angle), 0.2));
  }
  std::vector<std::uint32_t> list(const glm::dvec3& at) const {
    std::vector<std::uint32_t> out;
    file->decode(*RegionFinder(file->space()).find(surface.frame.to_unit(at)), Product::Matte, out);
    return out;
  }
};

std::vector<std::uint32_t> copy(const RegionList& list) { return {list.indices.begin(), list.indices.end()}; }

TEST(RegionLists, WholeMeshIsDrawnUntilTheListIsThere) {
  const Baked4 baked;
  RegionLists lists(baked.file);
  const RegionList first = lists.at(baked.eye(0));
  EXPECT_EQ(first.whole, first.indices.empty());  // whole, unless the thread was quick
  lists.wait();
  const RegionList then = lists.at(baked.eye(0));
  ASSERT_FALSE(then.whole);
  EXPECT_EQ(copy(then), baked.list(baked.eye(0)));
  EXPECT_GT(then.serial, 0u);
  EXPECT_EQ(lists.at(baked.eye(0.001)).serial, then.serial) << "the same region: nothing to upload";
}

TEST(RegionLists, DecodesAtOnceIfAsked) {
  const Baked4 baked;
  RegionListsOptions options;
  options.decode_at_once = true;
  options.kept = 4;
  RegionLists lists(baked.file, options);
  for (double angle = 0; angle < 13; angle += 0.11) {
    const RegionList list = lists.at(baked.eye(angle));
    ASSERT_FALSE(list.whole);
    ASSERT_EQ(copy(list), baked.list(baked.eye(angle)));
  }
}

TEST(RegionLists, RegionAheadIsThereWhenTheEyeComesToIt) {
  const Baked4 baked;
  RegionLists lists(baked.file);
  // Each frame leaves the thread the time it needs, so whatever is whole was not foreseen.
  int whole = 0;
  for (double angle = 0; angle < 6.2; angle += 0.05) {
    whole += lists.at(baked.eye(angle)).whole;
    lists.wait();
  }
  EXPECT_EQ(whole, 1) << "only the first region";

  RegionListsOptions options;
  options.decode_ahead = false;
  options.kept = 4;
  RegionLists without(baked.file, options);
  whole = 0;
  for (double angle = 0; angle < 6.2; angle += 0.05) {
    whole += without.at(baked.eye(angle)).whole;
    without.wait();
  }
  EXPECT_GT(whole, 8) << "each region is met unprepared";
}

TEST(RegionLists, KeepsTheLastListsAndForgetsTheOldest) {
  const Baked4 baked;
  RegionListsOptions options;
  options.kept = 4;
  options.decode_ahead = false;
  RegionLists lists(baked.file, options);
  const auto visit = [&](double angle) {
    const bool was_there = !lists.at(baked.eye(angle)).whole;
    lists.wait();
    lists.at(baked.eye(angle));
    return was_there;
  };
  for (const double angle : {0.0, 0.8, 1.6, 2.4}) visit(angle);
  for (const double angle : {0.8, 1.6, 2.4}) EXPECT_TRUE(visit(angle));
  visit(3.2);  // takes the place of the oldest, the first
  EXPECT_TRUE(visit(1.6));
  EXPECT_FALSE(visit(0));
}

TEST(RegionLists, WholeMeshInsideTheInnerRadiusAndForBrokenEyes) {
  const Baked4 baked;
  RegionLists lists(baked.file);
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(lists.at(baked.eye(0, 1.2)).whole);
    EXPECT_TRUE(lists.at({NAN, 0, 0}).whole);
    EXPECT_EQ(lists.at(baked.eye(0, 0)).serial, 0u);
    lists.wait();
  }
}

TEST(RegionLists, ColourListIsOfTheMeshsOwnVertices) {
  const Baked4 baked;
  std::vector<glm::uvec3> own = baked.surface.triangles;
  for (glm::uvec3& t : own) t += 1000;  // other numbers than the points'
  RegionListsOptions options;
  options.product = Product::Colour;
  options.decode_at_once = true;
  RegionLists lists(baked.file, options, own);
  const RegionList list = lists.at(baked.eye(1));
  ASSERT_FALSE(list.whole);
  std::vector<std::uint32_t> expected;
  baked.file->decode_colour(list.region, own, expected);
  EXPECT_EQ(copy(list), expected);
  EXPECT_GE(expected[0], 1000u);
}

TEST(RegionLists, ProductThatTheFileHasNotIsRefused) {
  const Baked4 baked;
  RegionListsOptions options;
  options.product = Product::Depth;
  EXPECT_THROW(RegionLists(baked.file, options), Error);
}

TEST(RegionLists, FastMovesNeverGiveAnotherRegionsList) {
  const Baked4 baked;
  RegionListsOptions options;
  options.kept = 4;
  RegionLists lists(baked.file, options);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> angle(0, 6.28);
  int listed = 0;
  for (int i = 0; i < 3000; ++i) {
    const glm::dvec3 eye = baked.eye(i % 3 == 0 ? angle(random) : i * 0.01);
    if (i % 10 == 0) std::this_thread::sleep_for(std::chrono::microseconds(500));
    const RegionList list = lists.at(eye);
    if (list.whole) continue;
    ++listed;
    ASSERT_EQ(list.region, *RegionFinder(baked.file->space()).find(baked.surface.frame.to_unit(eye)));
    ASSERT_EQ(list.indices.size(), 3 * std::size_t{baked.file->triangles(list.region, Product::Matte)});
    if (i % 97 == 0) {
      ASSERT_EQ(copy(list), baked.list(eye)) << "not written over while it is given out";
    }
  }
  EXPECT_GT(listed, 0);
}

}  // namespace
}  // namespace rinkaku::silhouette
