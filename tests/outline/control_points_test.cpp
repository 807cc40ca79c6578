#include "outline/control_points.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "outline/curvature.h"
#include "outline/feature_points.h"
#include "tests/outline/allocation_count.h"
#include "tests/outline/surfaces.h"

namespace rinkaku::test {
namespace {

using outline::ControlOptions;
using outline::ControlWidths;
using outline::FeaturePointOptions;
using outline::FeaturePoints;
using Kind = FeaturePoints::Kind;

std::vector<std::uint32_t> all_of(const mesh::Topology& topology) {
  std::vector<std::uint32_t> all(topology.points.size());
  for (std::uint32_t p = 0; p < all.size(); ++p) all[p] = p;
  return all;
}

double k95_of(const mesh::Topology& topology) { return outline::k95(outline::curvature(topology)); }

std::vector<Kind> kinds_of(const mesh::Topology& topology, const FeaturePointOptions& options) {
  FeaturePoints features(topology, k95_of(topology), options);
  const std::span<const Kind> found = features.find(topology.points, all_of(topology));
  return {found.begin(), found.end()};
}

// On a ball of radius r, normals stand at an angle of 90 degrees plus half the arc to the chord.
TEST(FeaturePoints, AngleSumIsThatOfTheFigure) {
  const double arc = 0.3;
  const glm::vec3 a(1, 0, 0), b(std::cos(arc), std::sin(arc), 0);
  EXPECT_NEAR(outline::angle_sum(a, a, b, b), std::numbers::pi + arc, 1e-6);    // convex, equation 3.3
  EXPECT_NEAR(outline::angle_sum(a, -a, b, -b), std::numbers::pi - arc, 1e-6);  // concave, equation 3.1
  EXPECT_NEAR(outline::angle_sum({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 0, 1}), std::numbers::pi, 1e-6);
  // Upright walls that face each other, and turn their backs on each other.
  EXPECT_NEAR(outline::angle_sum({0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {-1, 0, 0}), 0, 1e-6);
  EXPECT_NEAR(outline::angle_sum({0, 0, 0}, {-1, 0, 0}, {1, 0, 0}, {1, 0, 0}), 2 * std::numbers::pi, 1e-6);
  EXPECT_EQ(outline::angle_sum(a, a, a, a), std::numbers::pi);
}

// 40 points around a torus's tube of 0.7: along it an edge's arc is 9 degrees, so the sum is 189 outside. Along the
// ring the surface curves inwards on its inner side: by up to 1 / 0.3 a unit over edges of 0.3 * 6 degrees, 6 degrees.
TEST(FeaturePoints, ThresholdsInDegreesAreStrict) {
  const mesh::Topology torus = mesh::topology(Torus{}.mesh(60, 40));
  FeaturePointOptions options;
  options.by = FeaturePointOptions::By::Degrees;
  options.comparison = 1;
  const auto share = [&](double concave, double convex, Kind kind) {
    options.concave = concave, options.convex = convex;
    const std::vector<Kind> kinds = kinds_of(torus, options);
    return static_cast<double>(std::count(kinds.begin(), kinds.end(), kind)) / static_cast<double>(kinds.size());
  };
  EXPECT_EQ(share(0, 188.5, Kind::Convex), 1) << "all bend by 9 degrees across";
  EXPECT_EQ(share(0, 196, Kind::Convex), 0) << "none bends by more";
  EXPECT_EQ(share(170, 360, Kind::Concave), 0) << "none bends inwards by 10 degrees";
  const double inner = share(177, 360, Kind::Concave);
  EXPECT_GT(inner, 0.2);
  EXPECT_LT(inner, 0.5) << "only the inner side bends inwards";
}

TEST(FeaturePoints, ThresholdsInK95DoAtAnySizeAndFineness) {
  for (const double size : {1e-3, 1.0, 1e3}) {
    for (const int across : {24, 80}) {
      mesh::Mesh mesh = Torus{1, 0.2}.mesh(3 * across, across);
      for (glm::vec3& p : mesh.positions) p *= static_cast<float>(size);
      // The tube bends by 1 / 0.2 across; K95 is the mean with what it bends along the ring.
      FeaturePointOptions options;
      options.concave = 0;
      options.convex = 1.2;
      const std::vector<Kind> sharp = kinds_of(mesh::topology(mesh), options);
      EXPECT_EQ(std::count(sharp.begin(), sharp.end(), Kind::Convex), static_cast<std::ptrdiff_t>(sharp.size()));
      options.convex = 2.5;
      const std::vector<Kind> none = kinds_of(mesh::topology(mesh), options);
      EXPECT_EQ(std::count(none.begin(), none.end(), Kind::Convex), 0);
    }
  }
}

TEST(FeaturePoints, ComparisonCountsNeighbours) {
  // A point on a cube's edge row: of its neighbours some lie across the edge and bend, those along it don't.
  const mesh::Topology cone = mesh::topology(double_cone(12));
  FeaturePointOptions options;
  options.by = FeaturePointOptions::By::Degrees;
  options.convex = 181;
  options.concave = 0;
  // Each of the 12 points of the ring has four neighbours, all of them convex; a tip has twelve.
  for (const auto& [comparison, features] : {std::pair{3, 14}, std::pair{4, 2}, std::pair{11, 2}, std::pair{12, 0}}) {
    options.comparison = comparison;
    const std::vector<Kind> kinds = kinds_of(cone, options);
    EXPECT_EQ(std::count(kinds.begin(), kinds.end(), Kind::Convex), features) << comparison;
  }
}

TEST(FeaturePoints, NothingIsNoFeature) {
  // Flat, without area, alone.
  const mesh::Topology flat = grid_surface({6, 6}, [](double u, double v) { return glm::dvec3(u, v, 0); });
  for (const Kind kind : kinds_of(flat, {})) EXPECT_EQ(kind, Kind::None);
  mesh::Topology squeezed = flat;
  for (glm::vec3& p : squeezed.points) p = glm::vec3(0);
  for (const Kind kind : kinds_of(squeezed, {})) EXPECT_EQ(kind, Kind::None);
}

ControlOptions unsmoothed(double reach = 0) {
  ControlOptions options;
  options.features.convex = 0.3;
  options.smoothing = 0;
  options.exaggeration = 2;
  options.reach = reach;
  return options;
}

mesh::Topology ball() {
  return grid_surface({48, 24, true, false}, [](double u, double v) {
    const double a = 2 * std::numbers::pi * u, b = std::numbers::pi * (0.05 + 0.9 * (v - 0.5));
    return glm::dvec3(std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b));
  });
}

// Equation 3.5 with u = d0 squared, in base lines.
TEST(ControlWidths, FallOffWithTheSquareOfTheDistance) {
  const mesh::Topology surface = ball();
  const glm::vec3 control(1.5f, 0, 0);
  ControlOptions options = unsmoothed(0.6);
  ControlWidths widths(surface, k95_of(surface), std::span(&control, 1), options);
  const std::span<const float> found = widths.at(surface.points);
  for (std::size_t p = 0; p < found.size(); ++p) {
    const double d = glm::distance(surface.points[p], control);
    EXPECT_NEAR(found[p], 1 + 2 * std::min(0.36 / (d * d), 1.0), 1e-5);
  }
  options.distance = ControlOptions::Distance::Lengths;
  ControlWidths printed(surface, k95_of(surface), std::span(&control, 1), options);
  // All of the ball is as far from its middle: 0.5 less than the control point.
  for (const float factor : printed.at(surface.points)) EXPECT_NEAR(factor, 3, 1e-4);
}

TEST(ControlWidths, TakeTheNearestControlPoint) {
  const mesh::Topology surface = ball();
  const std::vector<glm::vec3> controls{{1.5f, 0, 0}, {-3, 0, 0}};
  ControlWidths widths(surface, k95_of(surface), controls, unsmoothed(0.5));
  const std::span<const float> found = widths.at(surface.points);
  for (std::size_t p = 0; p < found.size(); ++p) {
    const double d =
        std::min(glm::distance(surface.points[p], controls[0]), glm::distance(surface.points[p], controls[1]));
    EXPECT_NEAR(found[p], 1 + 2 * std::min(0.25 / (d * d), 1.0), 1e-5);
  }
}

TEST(ControlWidths, AreSoundWhereControlPointsLieOnTheSurface) {
  const mesh::Topology surface = ball();
  for (const auto distance : {ControlOptions::Distance::Apart, ControlOptions::Distance::Lengths}) {
    ControlOptions options = unsmoothed();
    options.distance = distance;
    ControlWidths widths(surface, k95_of(surface), surface.points, options);
    for (const float factor : widths.at(surface.points)) {
      EXPECT_GE(factor, 1);
      EXPECT_LE(factor, 3);
    }
  }
  ControlWidths none(surface, k95_of(surface), {}, unsmoothed());
  for (const float factor : none.at(surface.points)) EXPECT_EQ(factor, 1);
}

TEST(ControlWidths, ControlPointsGoWithTheSurface) {
  const mesh::Topology surface = mesh::topology(Torus{1, 0.3}.mesh(40, 20));
  const std::vector<glm::vec3> controls = outline::control_points_along(surface, 30, 0.2);
  ControlWidths widths(surface, k95_of(surface), controls, unsmoothed());
  const std::span<const float> rest = widths.at(surface.points);
  const std::vector<float> before(rest.begin(), rest.end());
  const glm::mat4 move = glm::rotate(glm::translate(glm::mat4(1), glm::vec3(3, -2, 1)), 1.3f, glm::vec3(0.2f, 1, 0.4f));
  std::vector<glm::vec3> moved;
  for (const glm::vec3& p : surface.points) moved.emplace_back(move * glm::vec4(p, 1));
  const std::span<const float> after = widths.at(moved);
  // Rounding of coordinates of about 4 in the distance of some 0.2, squared.
  for (std::size_t p = 0; p < before.size(); ++p) EXPECT_NEAR(after[p], before[p], 1e-4);
  const std::span<const glm::vec3> carried = widths.controls(moved);
  for (std::size_t c = 0; c < controls.size(); ++c) {
    EXPECT_LT(glm::distance(carried[c], glm::vec3(move * glm::vec4(controls[c], 1))), 1e-5f);
  }
}

TEST(ControlWidths, AtSomePointsAreThoseOfTheWholeWithoutAllocating) {
  const mesh::Topology surface = mesh::topology(Torus{}.mesh(60, 40));
  ControlOptions options;
  ControlWidths widths(surface, k95_of(surface), outline::control_points_along(surface, 40, 0.2), options);
  const std::span<const float> found = widths.at(surface.points);
  const std::vector<float> all(found.begin(), found.end());
  std::vector<float> factors(all.size());
  const std::vector<std::uint32_t> wanted{0, 1, 2, 2, 500, 1203, 1};
  widths.at(surface.points, wanted, factors);
  const long before = allocations();
  widths.at(surface.points, wanted, factors);
  EXPECT_EQ(allocations(), before);
  for (const std::uint32_t p : wanted) EXPECT_NEAR(factors[p], all[p], 1e-6);
}

TEST(ControlPoints, LieEvenlyAlongTheShape) {
  // A long bar: a sphere around it would be far from its middle.
  const mesh::Topology bar = grid_surface({32, 100, true, false}, [](double u, double v) {
    const double a = 2 * std::numbers::pi * u;
    return glm::dvec3(0.1 * std::cos(a), 0.1 * std::sin(a), 2 * v);
  });
  const double half_diagonal = std::sqrt(0.2 * 0.2 * 2 + 4) / 2, above = 0.1 * half_diagonal;
  const auto nearest = [](const glm::vec3& p, const std::vector<glm::vec3>& controls) {
    float least = 1e30f;
    for (const glm::vec3& c : controls) least = std::min(least, glm::distance(p, c));
    return least;
  };
  const auto spread = [&](const std::vector<glm::vec3>& controls) {
    float least = 1e30f, most = 0;
    for (const glm::vec3& p : bar.points) {
      least = std::min(least, nearest(p, controls));
      most = std::max(most, nearest(p, controls));
    }
    return most / least;
  };
  const std::vector<glm::vec3> along = outline::control_points_along(bar, 80, 0.1);
  ASSERT_EQ(along.size(), 80u);
  // Each stands that far off its point; on the rims outwards as well.
  for (const glm::vec3& c : along) EXPECT_NEAR(nearest(c, bar.points), above, 1e-5);
  EXPECT_LT(spread(along), 3);
  EXPECT_GT(spread(outline::control_points_on_sphere(bar, 80, 0.1)), 5);
}

TEST(ControlPoints, LieEvenlyOnTheSphere) {
  const mesh::Topology surface = ball();
  const std::vector<glm::vec3> controls = outline::control_points_on_sphere(surface, 100, 0.5);
  glm::vec3 sum(0);
  float least = 1e30f;
  for (std::size_t a = 0; a < controls.size(); ++a) {
    sum += controls[a];
    for (std::size_t b = 0; b < a; ++b) least = std::min(least, glm::distance(controls[a], controls[b]));
  }
  const float radius = glm::length(controls[0] - sum / 100.0f);
  EXPECT_NEAR(radius, 1.5 * std::sqrt(3.0), 0.1);
  // A hundred equal discs that cover a sphere have this spacing at best, sqrt(8 pi / (sqrt(3) n)); a spiral has 0.85 of
  // it.
  EXPECT_GT(least, 0.8 * radius * std::sqrt(8 * std::numbers::pi / (std::sqrt(3.0) * 100)));
}

}  // namespace
}  // namespace rinkaku::test
