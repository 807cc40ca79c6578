#include "outline/strokes/features.h"

#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "outline/strokes/radial_curvature.h"
#include "tests/outline/surfaces.h"
#include "tests/pipeline/passes/shapes.h"

namespace rinkaku::outline {
namespace {

std::size_t count(const mesh::Mesh& mesh, const FeatureOptions& options = {}) {
  return find_features(mesh, mesh::topology(mesh), options).list.size();
}

TEST(Features, CubeHasTwelveCreasesAndABallNone) {
  EXPECT_EQ(count(test::cube()), 12u);
  EXPECT_EQ(count(test::sphere(3)), 0u);
  FeatureOptions none;
  none.creases = false;
  EXPECT_EQ(count(test::cube(), none), 0u);
  FeatureOptions blunt;
  blunt.crease_deg = 95;  // a cube's edges are bent by 90
  EXPECT_EQ(count(test::cube(), blunt), 0u);
}

TEST(Features, MaterialsMeetInALine) {
  // A ball cut at z = 0 in two colours: an icosahedron's edges cross there, so the border runs zigzag around.
  mesh::Mesh mesh = test::sphere(2);
  std::stable_partition(mesh.triangles.begin(), mesh.triangles.end(), [&](const glm::uvec3& t) {
    return mesh.positions[t.x].z + mesh.positions[t.y].z + mesh.positions[t.z].z > 0;
  });
  const auto half = static_cast<std::uint32_t>(mesh.triangles.size() / 2);
  mesh.parts = {mesh.parts[0], mesh.parts[0]};
  mesh.parts[0].triangle_count = mesh.parts[1].triangle_count = mesh.parts[1].first_triangle = half;
  mesh.parts[1].material = 1;
  mesh.materials.push_back(mesh.materials[0]);
  EXPECT_EQ(count(mesh), 0u) << "of one look";
  mesh.materials[1].base_colour = glm::vec4(1, 0, 0, 1);
  const Features found = find_features(mesh, mesh::topology(mesh), {});
  ASSERT_GT(found.list.size(), 10u);
  // One closed line: each piece begins where the last ended.
  for (std::size_t i = 0; i < found.list.size(); ++i) {
    const Feature& next = found.list[(i + 1) % found.list.size()];
    EXPECT_EQ(found.welded[found.list[i].segment.to], found.welded[next.segment.from]) << i;
  }
}

TEST(Features, PiecesThatCutThroughEachOtherHaveALineThere) {
  mesh::Mesh mesh = test::cube();
  test::append(mesh, test::cube(), {1, 0.5f, 0.25f});
  FeatureOptions only_cuts;
  only_cuts.creases = only_cuts.materials = false;
  const Features found = find_features(mesh, mesh::topology(mesh), only_cuts);
  ASSERT_FALSE(found.list.empty());
  double length = 0;
  for (const Feature& feature : found.list) {
    const glm::vec3& a = found.more_positions[feature.segment.from - mesh.positions.size()];
    const glm::vec3& b = found.more_positions[feature.segment.to - mesh.positions.size()];
    length += glm::length(b - a);
  }
  // Where two boxes cut, each of three pairs of sides meets twice: the box they share is 1 x 1.5 x 1.75, and its edges
  // are cuts but for the three at each of the two corners that belong to one cube alone.
  EXPECT_NEAR(length, 2 * (1 + 1.5 + 1.75), 1e-4);
}

TEST(RadialCurvature, OfABallIsOneOverItsRadius) {
  mesh::Mesh mesh = test::sphere(4);
  for (glm::vec3& p : mesh.positions) p *= 2.5f;
  const mesh::Topology topology = mesh::topology(mesh);
  const RadialCurvature bends(topology);
  for (std::uint32_t p = 0; p < topology.points.size(); p += 7) {
    // Chords of a ball give its curvature exactly; normals averaged over faces are off by some thousandths.
    EXPECT_NEAR(bends.at(p, {1, 0.3f, -2}) * 2.5, 1, 0.02);
  }
}

// Two boxes that cut through each other: where one is taken away, the line's places are half-way, and how far apart the
// boxes have come is known; where both go together, the line goes with them.
TEST(Features, CutsGoWithTheFacesThatTheyAreIn) {
  mesh::Mesh mesh = test::cube();
  const std::size_t first = mesh.positions.size();
  test::append(mesh, test::cube(), {1, 0.5f, 0.25f});
  FeatureOptions only_cuts;
  only_cuts.creases = only_cuts.materials = false;
  const Features found = find_features(mesh, mesh::topology(mesh), only_cuts);
  ASSERT_EQ(found.cut_places.size(), found.more_positions.size());
  const auto moved = [&](const glm::vec3& one, const glm::vec3& other) {
    std::vector<glm::vec3> positions = mesh.positions;
    for (std::size_t v = 0; v < positions.size(); ++v) positions[v] += v < first ? one : other;
    MovedCuts cuts;
    cuts.move(found.cut_places, {reinterpret_cast<const std::byte*>(positions.data())});
    return cuts;
  };
  const glm::vec3 way(0.3f, -0.2f, 0.6f);
  const MovedCuts together = moved(way, way), parted = moved({0, 0, 0}, way);
  for (std::size_t i = 0; i < found.more_positions.size(); ++i) {
    constexpr double rounding = 1e-6;
    EXPECT_NEAR(glm::distance(together.positions[i], found.more_positions[i] + way), 0, rounding);
    EXPECT_NEAR(together.apart[i], 0, rounding);
    EXPECT_NEAR(glm::distance(parted.positions[i], found.more_positions[i] + way * 0.5f), 0, rounding);
    EXPECT_NEAR(parted.apart[i], glm::length(way), rounding);
  }
}

// A ball that becomes an ellipsoid, looked at anew at some points only.
TEST(RadialCurvature, OfAShapeThatMovesIsThatOfItsPose) {
  mesh::Mesh mesh = test::sphere(4);
  const mesh::Topology rest = mesh::topology(mesh);
  for (glm::vec3& p : mesh.positions) p *= glm::vec3(1, 1.6f, 0.7f);
  const mesh::Topology posed = mesh::topology(mesh);
  RadialCurvature moved(rest);
  const RadialCurvature fresh(posed);
  std::vector<std::uint32_t> wanted;
  for (std::uint32_t p = 0; p < rest.points.size(); p += 97) wanted.insert(wanted.end(), {p, p});
  moved.move(posed.points, posed.outline_normals, wanted);
  const glm::vec3 ways[] = {{1, 0.3f, -2}, {0, 1, 0}};
  for (const std::uint32_t p : wanted) {
    for (const glm::vec3& way : ways) EXPECT_EQ(moved.at(p, way), fresh.at(p, way));
  }
  // At the end of the long axis, b / a^2 and b / c^2 in the two directions across it; the fit over three rings of
  // chords a fifteenth of a turn long flattens the tip by a tenth.
  std::uint32_t tip = 0;
  for (std::uint32_t p = 0; p < posed.points.size(); ++p) tip = posed.points[p].y > posed.points[tip].y ? p : tip;
  const std::uint32_t one[] = {tip};
  moved.move(posed.points, posed.outline_normals, one);
  EXPECT_NEAR(moved.at(tip, {1, 0, 0}), 1.6, 0.16);
  EXPECT_NEAR(moved.at(tip, {0, 0, 1}), 1.6 / 0.49, 0.33);
}

TEST(RadialCurvature, OfATorusDependsOnTheDirection) {
  const test::Torus torus;
  const auto surface = [&](double u, double v) {
    const double a = 2 * std::numbers::pi * u, b = 2 * std::numbers::pi * v;
    const double ring = torus.outer + torus.inner * std::cos(b);
    return glm::dvec3(ring * std::cos(a), ring * std::sin(a), torus.inner * std::sin(b));
  };
  const mesh::Topology topology = test::grid_surface({96, 64, true, true}, surface);
  const RadialCurvature bends(topology);
  int outer = 0, inner = 0;
  for (std::uint32_t p = 0; p < topology.points.size(); ++p) {
    const glm::dvec3 at(topology.points[p]);
    const glm::vec3 around = glm::normalize(glm::vec3(-at.y, at.x, 0));
    const glm::vec3 across(glm::cross(glm::dvec3(topology.outline_normals[p]), glm::dvec3(around)));
    // Sampled at 4 to 6 degrees and averaged three rings wide, along edges askew to it: some hundredths.
    EXPECT_NEAR(bends.at(p, across), torus.largest(at), 0.06 * torus.largest(at));
    EXPECT_NEAR(bends.at(p, around), torus.smallest(at), 0.06 * std::max(torus.largest(at), -torus.smallest(at)));
    ++(bends.at(p, around) > 0 ? outer : inner);
  }
  EXPECT_GT(inner, 500) << "the inner side is hollow";
  EXPECT_GT(outer, 500);
}

}  // namespace
}  // namespace rinkaku::outline
