#include "silhouette/classify.h"

#include <cmath>

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

// A region of a billionth of the eye's distance, 1e4 radii off, at this sine of the angle over the plane z = 0. A
// radius beside 1e4 radii is 1e-4 of the angle.
ViewRegion tiny_region_at(double sine) {
  ViewRegion region;
  const glm::dvec3 eye = 1e4 * glm::dvec3(std::sqrt(1 - sine * sine), 0, sine);
  for (const glm::dvec3& d : {glm::dvec3(0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)}) {
    region.hull.emplace_back(eye + 1e-9 * d, 1);
  }
  return region;
}

TEST(Classify, EyeNearAPlaneIsDoubtfulByTheSineOfItsAngle) {
  const Surface surface = surface_of(test::square());  // faces +z
  const double sine = kFlattest / 0.5;                 // half a square's altitude is half its longest edge
  EXPECT_EQ(sides_of(surface, tiny_region_at(sine * 1.02))[0], Side::Front);
  EXPECT_EQ(sides_of(surface, tiny_region_at(sine * 0.98))[0], Side::Silhouette);
  EXPECT_EQ(sides_of(surface, tiny_region_at(-sine * 0.98))[0], Side::Silhouette);
  EXPECT_EQ(sides_of(surface, tiny_region_at(-sine * 1.02))[0], Side::Back);
}

TEST(Classify, SliverIsDoubtfulByHowFlatItLooks) {
  // Altitude 0.02 of the longest edge: too flat where the sine is below a fiftieth of that of a triangle as high as
  // wide.
  test::Soup soup;
  soup.positions = {{0, 0, 0}, {1, 0, 0}, {0.5f, 0.02f, 0}};
  soup.triangles = {{0, 1, 2}};
  const Surface surface = surface_of(test::one_part(soup));
  const double sine = kFlattest / 0.02;
  EXPECT_EQ(sides_of(surface, tiny_region_at(sine * 1.02))[0], Side::Front);
  EXPECT_EQ(sides_of(surface, tiny_region_at(sine * 0.98))[0], Side::Silhouette);
  soup.positions[2].y = static_cast<float>(kFlattest * 0.98);
  EXPECT_EQ(sides_of(surface_of(test::one_part(soup)), tiny_region_at(1))[0], Side::Silhouette);
}

}  // namespace
}  // namespace rinkaku::silhouette
