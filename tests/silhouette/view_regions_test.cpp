#include "silhouette/view_regions.h"

#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "pipeline/frame/error.h"

namespace rinkaku::silhouette {
namespace {

glm::dvec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

void every_eye_is_in_its_hull(const RegionLayout& layout) {
  const RegionFinder finder(layout);
  std::vector<RegionFinder> hulls;  // an explicit region is found by the planes of its hull, not by angles
  for (std::uint32_t r = 0; r < region_count(layout); ++r) hulls.emplace_back(view_region(layout, r));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> nearness(0, 1 / layout.inner_radii);
  std::vector<int> found(hulls.size(), 0);
  for (int i = 0; i < 200000; ++i) {
    const glm::dvec3 eye = random_direction(random) / nearness(random);
    const auto region = finder.find(eye);
    ASSERT_TRUE(region.has_value());
    ASSERT_LT(*region, hulls.size());
    ASSERT_TRUE(hulls[*region].find(eye).has_value()) << "region " << *region << ", distance " << glm::length(eye);
    ++found[*region];
  }
  EXPECT_GT(*std::min_element(found.begin(), found.end()), 0) << "a region that no eye is in";
}

TEST(ViewRegions, HullHoldsEveryEyeOfItsRegionInOneShell) { every_eye_is_in_its_hull({8, 1, 1.5}); }

TEST(ViewRegions, HullHoldsEveryEyeOfItsRegionThoughFiniteShellsBulge) { every_eye_is_in_its_hull({5, 3, 1.2}); }

TEST(ViewRegions, WideCellsHoldTheirEyesToo) { every_eye_is_in_its_hull({1, 2, 1.05}); }

TEST(ViewRegions, EyesOnCornersAndShellBordersAreInTheHullOfWhatIsFound) {
  const RegionLayout layout{6, 2, 1.5};
  const RegionFinder finder(layout);
  for (std::uint32_t r = 0; r < region_count(layout); ++r) {
    for (const glm::dvec4& h : view_region(layout, r).hull) {
      const glm::dvec3 direction = glm::normalize(glm::dvec3(h));
      for (const double distance : {1.5, 3.0, std::nextafter(3.0, 0.0), 1e3, 1e12}) {
        const auto region = finder.find(direction * distance);
        if (!region) {
          EXPECT_LT(glm::length(direction * distance), 1.5);
          continue;
        }
        EXPECT_TRUE(RegionFinder(view_region(layout, *region)).find(direction * distance)) << r << " at " << distance;
      }
    }
  }
}

TEST(ViewRegions, NothingIsFoundInsideTheInnerRadiusOrForEyesThatAreNoNumbers) {
  const RegionFinder finder(RegionLayout{4, 2, 1.5});
  EXPECT_FALSE(finder.find({0, 0, 0}));
  EXPECT_FALSE(finder.find({0, 1.4999, 0}));
  EXPECT_TRUE(finder.find({0, 1.5, 0}));
  EXPECT_FALSE(finder.find({0, std::numeric_limits<double>::quiet_NaN(), 2}));
  EXPECT_FALSE(finder.find({std::numeric_limits<double>::infinity(), 0, 0}));
}

TEST(ViewRegions, RegionsOfOneShellAreFartherThanThoseOfTheNext) {
  const RegionLayout layout{3, 4, 1.5};
  const RegionFinder finder(layout);
  // Uniform in 1/r: borders at 1.5, 2, 3, 6 radii and infinity.
  const glm::dvec3 direction = glm::normalize(glm::dvec3(1, 0.2, 0.1));
  std::uint32_t last = *finder.find(direction * 1.6);
  for (const double distance : {2.1, 3.1, 6.1}) {
    const std::uint32_t region = *finder.find(direction * distance);
    EXPECT_EQ(region, last + 6 * 3 * 3);
    last = region;
  }
}

TEST(ViewRegions, ExplicitBoxHoldsWhatLiesInIt) {
  ViewRegion box;
  for (int i = 0; i < 8; ++i) box.hull.emplace_back(i & 1 ? 3 : 2, i & 2 ? 1 : -1, i & 4 ? 1 : -1, 1);
  check(box, "box");
  const RegionFinder finder(box);
  EXPECT_TRUE(finder.find({2.5, 0, 0}));
  EXPECT_TRUE(finder.find({3, 1, 1})) << "a corner";
  EXPECT_TRUE(finder.find({2, 0, 1})) << "an edge";
  EXPECT_FALSE(finder.find({3.0001, 0, 0}));
  EXPECT_FALSE(finder.find({2.5, -1.0001, 0}));
}

TEST(ViewRegions, ExplicitRegionReachesToInfinityWhereItsVerticesDo) {
  ViewRegion cone{{{2, -1, -1, 1}, {2, 1, -1, 1}, {2, 0, 1, 1}, {1, 0, 0, 0}}};
  check(cone, "cone");
  const RegionFinder finder(cone);
  EXPECT_TRUE(finder.find({1e6, 0, 0}));
  EXPECT_FALSE(finder.find({1e6, 2, 0}));
  EXPECT_FALSE(finder.find({1.9, 0, 0}));
}

std::string refusal(const ViewSpace& space) {
  try {
    check(space, "here");
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_status(), 2);
    return error.what();
  }
  return "";
}

TEST(ViewRegions, UnusableSpacesAreRefusedWithTheReason) {
  EXPECT_NE(refusal(RegionLayout{0, 1, 1.5}).find("cells"), std::string::npos);
  EXPECT_NE(refusal(RegionLayout{8, 99, 1.5}).find("shells"), std::string::npos);
  EXPECT_NE(refusal(RegionLayout{8, 1, 0.9}).find("inner radius"), std::string::npos);
  EXPECT_NE(refusal(ViewRegion{{{2, 0, 0, 1}, {3, 0, 0, 1}, {2, 1, 0, 1}}}).find("hull vertices"), std::string::npos);
  EXPECT_NE(refusal(ViewRegion{{{2, 0, 0, 1}, {3, 0, 0, 1}, {2, 1, 0, 1}, {3, 1, 0, 1}}}).find("no volume"),
            std::string::npos);
  EXPECT_NE(refusal(ViewRegion{{{2, 0, 0, 1}, {3, 0, 0, 1}, {2, 1, 0, 1}, {-2, 0, 1, 1}}}).find("touches"),
            std::string::npos);
  EXPECT_NE(refusal(ViewRegion{{{2, 0, 0, 1}, {3, 0, 0, 1}, {2, 1, 0, 1}, {2, 0, NAN, 1}}}).find("not usable"),
            std::string::npos);
  EXPECT_EQ(refusal(ViewRegion{{{2, 0, 0, 1}, {3, 0, 0, 1}, {2, 1, 0, 1}, {2, 0, 1, 1}}}), "");
}

}  // namespace
}  // namespace rinkaku::silhouette
