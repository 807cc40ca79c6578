#include "outline/fluffy/band.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "outline/fluffy/nearest_view.h"
#include "tests/outline/fluffy/frames.h"

namespace rinkaku::test {
namespace {

using fluffy::BandCut;
using fluffy::BandSurface;

constexpr double deg = std::numbers::pi / 180;

// On a sphere seen from far away the faces within w / 2 of perpendicular lie between two circles of latitude about the
// line of sight: sin(w / 2) of its area.
TEST(Band, HoldsTheSineOfItsHalfWidthOfASphere) {
  const fluffy::Frame frame = frame_of(sphere(6));  // 32,768 faces
  const auto area = [&](std::uint32_t t) {
    const glm::dvec3 a = frame.points[frame.corners[t].x];
    return glm::length(glm::cross(glm::dvec3(frame.points[frame.corners[t].y]) - a,
                                  glm::dvec3(frame.points[frame.corners[t].z]) - a)) /
           2;
  };
  for (const double width_deg : {10.0, 45.0, 90.0}) {
    const double sine = fluffy::band_sine(width_deg * deg);
    BandCut cut(fluffy::by_faces(frame), sine);
    double sum = 0;
    for (const std::uint32_t t : cut.find({300, 1e4, -200})) sum += area(t);
    // A face is 0.03 wide and in the band by its middle: the border's unevenness averages out to far below that.
    EXPECT_NEAR(sum / (4 * std::numbers::pi), sine, 0.002) << width_deg;
  }
}

TEST(Band, NearEyesSeeItTurnedTowardsThem) {
  // From twice the radius the contour of a sphere is the circle where cos = 1 / 2.
  const BandSurface surface = fluffy::by_corners(frame_of(sphere(5)));
  BandCut cut(surface, fluffy::band_sine(1 * deg));
  const auto found = cut.find({0, 0, 2});
  ASSERT_FALSE(found.empty());
  for (const std::uint32_t t : found) {
    const glm::uvec3& c = surface.triangles[t];
    const float middle = (surface.points[c.x].z + surface.points[c.y].z + surface.points[c.z].z) / 3;
    // Facing falls by sqrt(3) / 2 of a radian there; a triangle is 0.05 wide and counts if any of it is in the band.
    EXPECT_NEAR(middle, 0.5, 0.06);
  }
}

TEST(Band, CutFindsAllThatDoublePrecisionFindsAndHardlyMore) {
  const BandSurface surface = fluffy::by_corners(frame_of(sphere(4)));
  const double sine = fluffy::band_sine(45 * deg);
  BandCut cut(surface, sine);
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int view = 0; view < 200; ++view) {
    const glm::dvec3 way = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    const glm::dvec3 eye = way * (1.2 + 3 * std::abs(normal(random)));
    const auto found = cut.find(eye);
    std::size_t next = 0;
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
      const bool listed = next < found.size() && found[next] == t;
      if (listed) ++next;
      if (fluffy::in_band(surface, t, sine, eye)) {
        EXPECT_TRUE(listed) << t;
      } else if (listed) {
        EXPECT_TRUE(fluffy::in_band(surface, t, sine + 3e-5, eye)) << t;  // the margin, and rounding
      }
    }
  }
}

TEST(Band, TriangleThatBendsAcrossTheContourIsInHoweverNarrowTheBand) {
  BandSurface surface;
  surface.points = {{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  surface.normals = {glm::normalize(glm::vec3(-1, 0, 1)), glm::normalize(glm::vec3(1, 0, -1)), {0, 0, 1}};
  surface.triangles = {{0, 1, 2}};
  EXPECT_TRUE(fluffy::in_band(surface, 0, 1e-6, {0, 0, 100}));
  surface.normals[1] = surface.normals[0];
  EXPECT_FALSE(fluffy::in_band(surface, 0, 0.5, {0, 0, 100}));
}

TEST(Band, FacesOfMirroredMeshesPointOutwards) {
  const BandSurface surface = fluffy::by_faces(frame_of(sphere(2), {}, glm::dmat3(-1, 0, 0, 0, 1, 0, 0, 0, 2)));
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    EXPECT_GT(glm::dot(surface.normals[t], surface.points[t]), 0) << t;
  }
}

// What the paper's form is for, and what it can't do.
TEST(NearestView, IsRightFromFarAtACandidateAndMissesTrianglesElsewhere) {
  const BandSurface surface = fluffy::by_faces(frame_of(sphere(4)));
  const double sine = fluffy::band_sine(45 * deg);
  const fluffy::NearestView views(surface, sine, 1);  // its only direction is +x
  const auto list = views.list({1, 0, 0});
  std::vector<std::uint32_t> far;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    if (fluffy::in_band(surface, t, sine, {1e9, 0, 0})) far.push_back(t);
  }
  EXPECT_TRUE(std::equal(list.begin(), list.end(), far.begin(), far.end()));
  std::size_t missed = 0;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    if (fluffy::in_band(surface, t, sine, {2, 0, 0}) && !std::binary_search(list.begin(), list.end(), t)) ++missed;
  }
  EXPECT_GT(missed, 0u);
}

}  // namespace
}  // namespace rinkaku::test
