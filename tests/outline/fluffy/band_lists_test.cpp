#include "outline/fluffy/band_lists.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "mesh/import.h"
#include "outline/fluffy/cutter.h"
#include "tests/outline/fluffy/frames.h"
#include "tests/support/test_data.h"

namespace rinkaku::test {
namespace {

using fluffy::BandLists;
using fluffy::BandSurface;

constexpr double pi = std::numbers::pi;

struct Surplus {
  std::uint64_t listed = 0, needed = 0, missed = 0;
};

// Eyes even over the sphere of directions and over 1 / distance, from the inner radius to a hundred radii.
Surplus held_against_brute_force(const BandSurface& surface, const BandLists& lists, double sine, double inner,
                                 int views) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> nearness(0.01, 1 / inner);
  std::vector<std::uint32_t> list;
  Surplus sum;
  for (int view = 0; view < views; ++view) {
    const glm::dvec3 way = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    const glm::dvec3 eye = lists.unit_frame().to_mesh(way * 1.0001 / nearness(random));
    const auto region = lists.region(eye);
    EXPECT_TRUE(region.has_value());
    if (!region) continue;
    lists.list(*region, list);
    sum.listed += list.size();
    std::size_t next = 0;
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
      while (next < list.size() && list[next] < t) ++next;
      if (!fluffy::in_band(surface, t, sine, eye)) continue;
      ++sum.needed;
      if (next == list.size() || list[next] != t) ++sum.missed;
    }
  }
  return sum;
}

TEST(BandLists, MissNothingInTenThousandViewsAndListLittleMore) {
  const silhouette::RegionLayout layout = fluffy::CutOptions{}.regions;
  const double sine = fluffy::band_sine(pi / 4);
  const BandSurface surface = fluffy::by_corners(frame_of(sphere(3)));  // 512 triangles
  const BandLists lists(surface, sine, layout);
  const Surplus sum = held_against_brute_force(surface, lists, sine, layout.inner_radii, 10'000);
  EXPECT_EQ(sum.missed, 0u);
  EXPECT_LE(static_cast<double>(sum.listed), 1.25 * static_cast<double>(sum.needed));  // what users were promised
  EXPECT_GT(sum.listed, sum.needed);
}

TEST(BandLists, MissNothingOnARealMeshThatFoldsAndIsScaledUnevenly) {
  RINKAKU_NEEDS_DATA();
  const mesh::Mesh mesh = mesh::import(data("meshes/closed/spot_textured_5k9.obj")).mesh;
  const glm::dmat3 place(0.2, 0.1, 0, 0, 0.3, 0, 0, 0, -0.1);
  const fluffy::Frame frame = fluffy::make_frame(mesh, mesh::topology(mesh), place, {}, "scene");
  const double sine = fluffy::band_sine(pi / 3);
  const silhouette::RegionLayout layout{.cells = 6, .shells = 3, .inner_radii = 1.5};
  const BandSurface surface = fluffy::by_corners(frame);
  const Surplus sum =
      held_against_brute_force(surface, BandLists(surface, sine, layout), sine, layout.inner_radii, 500);
  EXPECT_GT(sum.needed, 0u);
  EXPECT_EQ(sum.missed, 0u);
}

TEST(BandLists, KnowNoRegionInsideTheInnerRadius) {
  const BandSurface surface = fluffy::by_corners(frame_of(sphere(1)));
  const BandLists lists(surface, 0.3, {.cells = 2, .shells = 1, .inner_radii = 1.5});
  EXPECT_FALSE(lists.region({0, 0, 1.49}));
  EXPECT_TRUE(lists.region({0, 0, 1.51}));
  EXPECT_EQ(lists.region_count(), 24u);
}

TEST(Cutter, AllMethodsButThePapersFindWhatIsInTheBand) {
  const fluffy::Frame frame = frame_of(sphere(4));
  const BandSurface surface = fluffy::by_corners(frame);
  fluffy::CutOptions options;
  options.sine = fluffy::band_sine(pi / 4);
  options.regions = {.cells = 4, .shells = 2, .inner_radii = 1.5};
  std::vector<std::uint32_t> needed;
  for (const double distance : {1.2, 1.6, 5.0}) {  // inside the inner radius as well
    const glm::dvec3 eye = distance * glm::normalize(glm::dvec3(1, 2, 3));
    needed.clear();
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
      if (fluffy::in_band(surface, t, options.sine, eye)) needed.push_back(t);
    }
    std::size_t last = needed.size();
    for (const auto method : {fluffy::CutMethod::Exact, fluffy::CutMethod::Regions, fluffy::CutMethod::None}) {
      options.method = method;
      fluffy::Cutter cutter(frame, options);
      for (int again = 0; again < 2; ++again) {
        const auto found = cutter.find(eye);
        EXPECT_TRUE(std::includes(found.begin(), found.end(), needed.begin(), needed.end())) << distance;
        EXPECT_GE(found.size(), last);  // each method finds more than the one before
        last = found.size();
      }
    }
    EXPECT_EQ(last, surface.triangles.size());
  }
}

}  // namespace
}  // namespace rinkaku::test
