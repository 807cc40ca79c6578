#include "silhouette/surface.h"

#include <gtest/gtest.h>

#include "pipeline/frame/error.h"
#include "tests/silhouette/surfaces.h"

namespace rinkaku::silhouette {
namespace {

using test::surface_from;
using test::surface_of;

TEST(Surface, ClosedMeshStaysSingleSided) {
  const Surface s = surface_of(test::sphere(3));
  EXPECT_EQ(s.treatment.single_sided_components, 1u);
  EXPECT_EQ(s.treatment.two_sided_triangles, 0u);
  EXPECT_EQ(full_list(s).size(), s.triangles.size() * 3);
  for (const glm::uvec3& n : s.neighbours) EXPECT_TRUE(n.x != kNone && n.y != kNone && n.z != kNone);
}

TEST(Surface, NeighboursShareTheSideTheyAreListedFor) {
  const Surface s = surface_of(test::shuffled_winding(test::sphere(2), 3));
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    for (int side = 0; side < 3; ++side) {
      const glm::uvec3& other = s.triangles[s.neighbours[t][side]];
      const std::uint32_t from = s.triangles[t][side];
      const std::uint32_t to = s.triangles[t][(side + 1) % 3];
      bool runs_against = false;
      for (int i = 0; i < 3; ++i) runs_against = runs_against || (other[i] == to && other[(i + 1) % 3] == from);
      EXPECT_TRUE(runs_against);
    }
  }
}

TEST(Surface, OpenMeshGetsAReversedCopyOfEachTriangle) {
  const Surface s = surface_of(test::square());
  EXPECT_EQ(s.treatment.two_sided_components, 1u);
  EXPECT_EQ(s.treatment.two_sided_triangles, 2u);
  const auto list = full_list(s);
  ASSERT_EQ(list.size(), 12u);
  EXPECT_EQ(list[0], list[3]);
  EXPECT_EQ(list[1], list[5]);
  EXPECT_EQ(list[2], list[4]);
}

// A square's two triangles have sides of 1, 1 and sqrt(2), and its bounding sphere the radius sqrt(1/2).
TEST(Surface, ListsHoldWhileThreeEdgesOfFourTakeAnEighthOfAPixel) {
  const double expected_px = std::sqrt(0.5) / 8;
  EXPECT_NEAR(least_radius_px(surface_of(test::square())), expected_px, 1e-6);  // positions are floats
  auto larger = test::square();
  for (glm::vec3& p : larger.positions) p *= 1000.0f;
  EXPECT_NEAR(least_radius_px(surface_of(larger)), expected_px, 1e-6);
}

TEST(Surface, ClosedMeshWithShuffledWindingIsRepairedOutsideOut) {
  const Surface s = surface_of(test::shuffled_winding(test::sphere(3), 3));
  EXPECT_EQ(s.treatment.repaired_components, 1u);
  EXPECT_GT(s.treatment.turned_triangles, 0u);
  EXPECT_EQ(s.treatment.two_sided_triangles, 0u);
  for (const glm::uvec3& t : s.triangles) {
    const glm::vec3 normal = glm::cross(s.points[t.y] - s.points[t.x], s.points[t.z] - s.points[t.x]);
    EXPECT_GT(glm::dot(normal, s.points[t.x]), 0);
  }
}

TEST(Surface, OneSidedMeshIsDrawnFromBothSides) {
  const Surface s = surface_of(test::moebius(40, 3));
  EXPECT_EQ(s.treatment.two_sided_components, 1u);
  EXPECT_EQ(s.treatment.two_sided_triangles, s.triangles.size());
}

TEST(Surface, FitsTheUnitSphereWhereverTheMeshIs) {
  test::Soup soup = test::sphere(2);
  for (glm::vec3& p : soup.positions) p = p * 3.0f + glm::vec3(1000, -50, 7);
  const Surface s = surface_of(soup);
  double farthest = 0;
  for (const glm::vec3& p : s.points) farthest = std::max(farthest, glm::length(s.frame.to_unit(p)));
  EXPECT_LE(farthest, 1.0);
  EXPECT_GT(farthest, 1 - 1e-8);
}

TEST(Surface, HashTellsMeshesApart) {
  test::Soup moved = test::sphere(2);
  moved.positions[5].x += 1e-6f;
  test::Soup open = test::sphere(2);
  open.triangles.pop_back();
  const std::uint64_t hash = surface_of(test::sphere(2)).hash;
  EXPECT_EQ(surface_of(test::sphere(2)).hash, hash);
  EXPECT_NE(surface_of(moved).hash, hash);
  EXPECT_NE(surface_of(test::one_part(open)).hash, hash);
}

TEST(Surface, MeshWithoutSizeIsRefused) {
  mesh::Mesh mesh;
  EXPECT_THROW(surface_of(mesh), Error);
}

TEST(Surface, RealMeshesAreRepairedOrTwoSided) {
  RINKAKU_NEEDS_DATA();
  const auto shuffled = surface_from("meshes/dirty/cgal_blobby_shuffled_winding.off").treatment;
  EXPECT_EQ(shuffled.repaired_components, 1u);
  EXPECT_EQ(shuffled.two_sided_components, 0u);
  const auto open = surface_from("meshes/open/pmp_hemisphere_3k6.off").treatment;
  EXPECT_EQ(open.two_sided_components, 1u);
  EXPECT_EQ(open.two_sided_triangles, 3600u);
}

}  // namespace
}  // namespace rinkaku::silhouette
