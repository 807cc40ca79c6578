#include "outline/line_width.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/outline/allocation_count.h"
#include "tests/outline/surfaces.h"

namespace rinkaku::test {
namespace {

using outline::Curvature;
using outline::CurvatureKind;
using outline::CurvatureSign;
using outline::line_width_factors;
using outline::WidthOptions;

// A row of points, each joined to the next, with given curvatures.
mesh::Topology row(std::size_t count) {
  mesh::Topology topology;
  topology.points.resize(count);
  for (std::uint32_t p = 0; p + 1 < count; ++p) {
    mesh::Edge edge;
    edge.a = p, edge.b = p + 1;
    topology.edges.push_back(edge);
  }
  return topology;
}

Curvature with_mean(const std::vector<float>& mean) {
  Curvature c;
  c.mean = mean;
  c.gauss = c.largest = c.smallest = c.area = std::vector<float>(mean.size(), 0.0f);
  return c;
}

WidthOptions unsmoothed() {
  WidthOptions options;
  options.smoothing = 0;
  return options;
}

void expect_factors(const std::vector<float>& found, const std::vector<double>& wish) {
  ASSERT_EQ(found.size(), wish.size());
  // A few roundings of float.
  for (std::size_t p = 0; p < wish.size(); ++p) EXPECT_NEAR(found[p], wish[p], 1e-6) << p;
}

// With u = 2 px, t = 5 px and s = 40 / m: V is 2, 2 + 10 / 40 * 5 = 3.25, 4.5, 7 from K = s on, hollow or hump alike.
TEST(LineWidth, ThesisEquation43IsOneOfTheSettings) {
  const double u = 2, t = 5, s = 40, k95 = 25;
  WidthOptions options = unsmoothed();
  options.exaggeration = static_cast<float>(t / u);
  options.saturation = static_cast<float>(s / k95);
  std::vector<float> widths = line_width_factors(row(6), with_mean({0, 10, 20, 40, 400, -20}), k95, options);
  for (float& w : widths) w *= static_cast<float>(u);
  expect_factors(widths, {2, 3.25, 4.5, 7, 7, 4.5});
}

TEST(LineWidth, SignChoosesWhatGetsThinner) {
  WidthOptions options = unsmoothed();
  options.exaggeration = 1;
  const Curvature c = with_mean({0, 1, 2, 9, -1, -2, -9});
  options.sign = CurvatureSign::Convex;
  expect_factors(line_width_factors(row(7), c, 2, options), {1, 1.5, 2, 2, 1 / 1.5, 0.5, 0.5});
  options.sign = CurvatureSign::Concave;
  expect_factors(line_width_factors(row(7), c, 2, options), {1, 1 / 1.5, 0.5, 0.5, 1.5, 2, 2});
}

TEST(LineWidth, ThinLinesStopAtTheLeast) {
  WidthOptions options = unsmoothed();
  options.sign = CurvatureSign::Convex;
  options.exaggeration = 4;
  options.least = 0.3f;
  expect_factors(line_width_factors(row(3), with_mean({-1, -0.25f, 1}), 1, options), {0.3, 0.5, 5});
}

TEST(LineWidth, CurveBendsTheWayToTheMost) {
  WidthOptions options = unsmoothed();
  options.curve = 0.5f;
  expect_factors(line_width_factors(row(3), with_mean({0.25f, 1, 3}), 1, options), {1 + 2 * 0.5, 3, 3});
  options.curve = 2;
  expect_factors(line_width_factors(row(3), with_mean({0.25f, 1, 3}), 1, options), {1 + 2 * 0.0625, 3, 3});
}

TEST(LineWidth, EachKindReadsItsCurvatureAsOneOverLength) {
  Curvature c;
  c.mean = {1}, c.gauss = {-4}, c.largest = {3}, c.smallest = {-0.5f}, c.area = {1};
  WidthOptions options = unsmoothed();
  options.exaggeration = 1;
  options.saturation = 10;
  options.sign = CurvatureSign::Convex;
  const auto of = [&](CurvatureKind kind) {
    options.kind = kind;
    return line_width_factors(row(1), c, 1, options);
  };
  expect_factors(of(CurvatureKind::Mean), {1.1});
  expect_factors(of(CurvatureKind::Gauss), {1 / 1.2});
  expect_factors(of(CurvatureKind::Largest), {1.3});
  expect_factors(of(CurvatureKind::Smallest), {1 / 1.05});
}

TEST(LineWidth, SmoothingAveragesOverNeighbours) {
  WidthOptions options;
  options.exaggeration = 8;
  options.smoothing = 1;
  // Factors 1 1 9 1 1. Once: the middle is (9 + 1) / 2, beside it (1 + (1 + 9) / 2) / 2, the ends stay.
  const Curvature c = with_mean({0, 0, 1, 0, 0});
  expect_factors(line_width_factors(row(5), c, 1, options), {1, 3, 5, 3, 1});
  options.smoothing = 2;
  expect_factors(line_width_factors(row(5), c, 1, options), {2, 3, 4, 3, 2});
}

TEST(LineWidth, FlatSurfacesHaveTheBaseLine) {
  expect_factors(line_width_factors(row(2), with_mean({0, 0}), 0, WidthOptions{}), {1, 1});
}

mesh::Mesh dented_torus() {
  mesh::Mesh mesh = Torus{}.mesh(60, 40);
  for (glm::vec3& p : mesh.positions) p.z += 0.1f * std::sin(9 * p.x) * std::cos(7 * p.y);
  return mesh;
}

TEST(CurvatureWidths, AreThoseOfTheSurfaceAsItIs) {
  const mesh::Topology rest = mesh::topology(Torus{}.mesh(60, 40)), dented = mesh::topology(dented_torus());
  WidthOptions options;
  options.sign = CurvatureSign::Convex;
  const std::vector<float> once =
      line_width_factors(dented, outline::curvature(dented), outline::k95(outline::curvature(rest)), options);
  outline::CurvatureWidths widths(rest, options);
  const std::span<const float> found = widths.at(dented.points);
  // Sums in another order.
  for (std::size_t p = 0; p < once.size(); ++p) EXPECT_NEAR(found[p], once[p], 1e-5) << p;
}

TEST(CurvatureWidths, AtSomePointsAreThoseOfTheWhole) {
  const mesh::Topology rest = mesh::topology(Torus{}.mesh(60, 40)), dented = mesh::topology(dented_torus());
  for (const CurvatureKind kind : {CurvatureKind::Mean, CurvatureKind::Gauss, CurvatureKind::Smallest}) {
    for (const int smoothing : {0, 1, 3, 100}) {
      WidthOptions options;
      options.kind = kind;
      options.smoothing = smoothing;
      outline::CurvatureWidths whole(rest, options), some(rest, options);
      // The second call must not be misled by what the first one left.
      for (const mesh::Topology* surface : {&rest, &dented}) {
        const std::span<const float> all = whole.at(surface->points);
        std::vector<float> factors(all.size(), -1.0f);
        const std::vector<std::uint32_t> wanted{0, 1, 2, 2, 500, 1203, 1};
        some.at(surface->points, wanted, factors);
        for (const std::uint32_t p : wanted) EXPECT_NEAR(factors[p], all[p], 1e-5) << smoothing;
        EXPECT_EQ(std::count(factors.begin(), factors.end(), -1.0f), static_cast<std::ptrdiff_t>(all.size() - 5));
      }
    }
  }
}

TEST(CurvatureWidths, AllocateNothingOnceWarm) {
  const mesh::Topology rest = mesh::topology(Torus{}.mesh(60, 40));
  outline::CurvatureWidths widths(rest, {});
  std::vector<float> factors(rest.points.size());
  const std::vector<std::uint32_t> wanted{0, 1, 2, 500, 1203};
  widths.at(rest.points, wanted, factors);
  const long before = allocations();
  widths.at(rest.points, wanted, factors);
  EXPECT_EQ(allocations(), before);
}

}  // namespace
}  // namespace rinkaku::test
