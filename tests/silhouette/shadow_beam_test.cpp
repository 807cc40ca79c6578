#include "silhouette/shadow_beam.h"

#include <random>

#include <gtest/gtest.h>

#include "silhouette/nearest_in_simplex.h"
#include "tests/silhouette/surfaces.h"

namespace rinkaku::silhouette {
namespace {

const std::array<glm::dvec3, 3> kTriangle{{{0.1, 0, 0}, {0, 0.1, 0}, {-0.1, -0.1, 0.05}}};

ViewRegion above() {  // of +z
  return view_region(RegionLayout{8, 1, 1.5}, *RegionFinder(RegionLayout{8, 1, 1.5}).find({0.1, 0.1, 3}));
}

TEST(ShadowBeam, WhatLiesBesideOrBeforeItIsClear) {
  ShadowBeam beam;
  beam.set_region(above());
  beam.set_triangle(kTriangle);
  EXPECT_TRUE(beam.is_clear_of({0.5, 0.5, 0}, {0.6, -0.5, 0.1})) << "beside";
  EXPECT_TRUE(beam.is_clear_of({0.12, 0.12, -0.01}, {0.9, 0.1, -0.3})) << "pointing at it";
  EXPECT_FALSE(beam.is_clear_of({-0.5, 0, -0.5}, {0.5, 0, -0.5})) << "behind";
  EXPECT_FALSE(beam.is_clear_of({-0.5, 0, 0.5}, {0.5, 0, 0.5})) << "between the eyes and it";
  EXPECT_FALSE(beam.is_clear_of({0.1, 0, 0}, {0.5, 0.5, 0})) << "from its corner";
}

TEST(ShadowBeam, NoRayFromAnEyeMeetsASegmentCalledClear) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> along(-0.57, 0.57);
  std::uniform_real_distribution<double> unit(0, 1);
  const ViewRegion region = above();
  ShadowBeam beam;
  beam.set_region(region);
  beam.set_triangle(kTriangle);
  int clear = 0;
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 p(along(random), along(random), along(random));
    const glm::dvec3 q = p + 0.3 * glm::dvec3(along(random), along(random), along(random));
    if (!beam.is_clear_of(p, q)) continue;
    ++clear;
    for (int k = 0; k < 200; ++k) {
      const glm::dvec3 eye = test::eye_in(region, random);
      const glm::dvec3 y = p + unit(random) * (q - p);
      // The ray from the eye through y must miss the triangle's plane inside the triangle.
      const auto side = [&](int a, int b) {
        return glm::dot(glm::cross(kTriangle[a] - eye, kTriangle[b] - eye), y - eye);
      };
      const double s[] = {side(0, 1), side(1, 2), side(2, 0)};
      const bool through = (s[0] > 0 && s[1] > 0 && s[2] > 0) || (s[0] < 0 && s[1] < 0 && s[2] < 0);
      ASSERT_FALSE(through);
    }
  }
  EXPECT_GT(clear, 1000);
  EXPECT_LT(clear, 2000);
}

TEST(NearestInSimplex, IsNoFartherThanAnyPointOfTheHull) {
  std::mt19937 random(12);
  std::normal_distribution<double> normal;
  std::exponential_distribution<double> weight(1);
  for (int i = 0; i < 2000; ++i) {
    Simplex simplex;
    simplex.size = 1 + i % 4;
    for (int k = 0; k < simplex.size; ++k) simplex.points[k] = {normal(random) + 0.5, normal(random), normal(random)};
    const Simplex all = simplex;
    const double distance = glm::length(nearest_in_simplex(simplex));
    EXPECT_LE(simplex.size, all.size);
    for (int k = 0; k < 100; ++k) {
      glm::dvec3 sum(0);
      double total = 0;
      for (int j = 0; j < all.size; ++j) {
        const double w = weight(random);
        sum += w * all.points[j];
        total += w;
      }
      ASSERT_LE(distance, glm::length(sum / total) + 1e-12);
    }
  }
}

}  // namespace
}  // namespace rinkaku::silhouette
