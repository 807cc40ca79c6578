#include "silhouette/classify.h"

#include <gtest/gtest.h>

#include "tests/silhouette/surfaces.h"

namespace rinkaku::silhouette {
namespace {

using test::eye_in;
using test::surface_of;

std::vector<Side> sides_of(const Surface& surface, const ViewRegion& region) {
  std::vector<Side> sides;
  classify(triangle_planes(surface), region, sides);
  return sides;
}

double height(const Surface& surface, std::size_t t, const glm::dvec3& eye) {
  const glm::uvec3& v = surface.triangles[t];
  const glm::dvec3 a = surface.frame.to_unit(surface.points[v.x]);
  const glm::dvec3 b = surface.frame.to_unit(surface.points[v.y]);
  const glm::dvec3 c = surface.frame.to_unit(surface.points[v.z]);
  return glm::dot(glm::cross(b - a, c - a), eye - a);
}

TEST(Classify, FrontFacesEveryEyeAndBackNone) {
  const Surface surface = surface_of(test::wavy_sphere(4));
  std::mt19937 random(2);
  for (const std::uint32_t r : {0u, 9u, 57u, 100u}) {
    const ViewRegion region = view_region(RegionLayout{4, 2, 1.5}, r);
    const std::vector<Side> sides = sides_of(surface, region);
    for (int i = 0; i < 200; ++i) {
      const glm::dvec3 eye = eye_in(region, random);
      for (std::size_t t = 0; t < sides.size(); ++t) {
        if (sides[t] == Side::Front) {
          ASSERT_GT(height(surface, t, eye), 0);
        }
        if (sides[t] == Side::Back) {
          ASSERT_LT(height(surface, t, eye), 0);
        }
      }
    }
  }
}

TEST(Classify, SilhouetteTrianglesAreThoseWhosePlaneCutsTheHull) {
  const Surface surface = surface_of(test::sphere(4));
  const ViewRegion region = view_region(RegionLayout{8, 1, 1.5}, 20);
  const std::vector<Side> sides = sides_of(surface, region);
  std::size_t counts[3] = {};
  for (std::size_t t = 0; t < sides.size(); ++t) {
    ++counts[static_cast<int>(sides[t])];
    bool in_front = false;
    bool behind = false;
    for (const glm::dvec4& h : region.hull) {
      // Infinity by a far point: 1e9 radii away the plane's offset is lost.
      const double above = height(surface, t, glm::dvec3(h) * (h.w > 0 ? 1.0 : 1e9));
      (above > 0 ? in_front : behind) = true;
    }
    if (in_front && behind) {
      EXPECT_EQ(sides[t], Side::Silhouette);
    }
  }
  for (const std::size_t count : counts) EXPECT_GT(count, sides.size() / 20);
}

TEST(Classify, EyeNearAPlaneIsDoubtfulByTheSineOfItsAngle) {
  // The square faces +z; a tiny region above it, seen at a grazing angle, over the origin's corner.
  const Surface surface = surface_of(test::square());
  const auto tiny_region_at = [&](double sine) {
    // The margin is measured from a corner: the same angle from all of them, far away.
    ViewRegion region;
    const double size = 1e-9;
    const glm::dvec3 eye = 1e4 * glm::dvec3(std::sqrt(1 - sine * sine), 0, sine);
    for (const glm::dvec3& d : {glm::dvec3(0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)}) {
      region.hull.emplace_back(eye + size * d, 1);
    }
    return region;
  };
  // A radius beside 1e4 radii: 1e-4 of the angle.
  EXPECT_EQ(sides_of(surface, tiny_region_at(kMargin * 1.01))[0], Side::Front);
  EXPECT_EQ(sides_of(surface, tiny_region_at(kMargin * 0.99))[0], Side::Silhouette);
  EXPECT_EQ(sides_of(surface, tiny_region_at(-kMargin * 0.99))[0], Side::Silhouette);
  EXPECT_EQ(sides_of(surface, tiny_region_at(-kMargin * 1.01))[0], Side::Back);
}

TEST(Classify, SliversAreDoubtfulFromEverywhere) {
  test::Soup soup;
  soup.positions = {{0, 0, 0}, {1, 0, 0}, {0.5f, 0.0099f, 0}, {0, 0, 1}, {1, 0, 1}, {0.5f, 0.0101f, 1}, {2, 0, 0}};
  soup.triangles = {{0, 1, 2}, {3, 4, 5}, {0, 1, 6}};
  const Surface surface = surface_of(test::one_part(soup));
  const ViewRegion above = view_region(RegionLayout{1, 1, 2.0}, 4);
  const std::vector<Side> sides = sides_of(surface, above);
  ASSERT_EQ(sides.size(), 3u);
  for (std::size_t t = 0; t < 3; ++t) {
    const bool the_wider = surface.points[surface.triangles[t].x].z == 1;
    EXPECT_EQ(sides[t], the_wider ? Side::Front : Side::Silhouette);
  }
}

}  // namespace
}  // namespace rinkaku::silhouette
