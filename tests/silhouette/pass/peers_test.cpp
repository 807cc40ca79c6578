// The methods that region meshes are compared with.
#include <algorithm>
#include <set>

#include "silhouette/bake.h"
#include "silhouette/peers/cluster_cones.h"
#include "silhouette/peers/reduction.h"
#include "silhouette/region_file.h"
#include "silhouette/verify/matte_comparison.h"
#include "tests/pipeline/passes/gl_test.h"
#include "tests/silhouette/surfaces.h"

namespace rinkaku::silhouette {
namespace {

using Reduce = std::vector<std::uint32_t> (*)(std::span<const glm::vec3>, std::span<const std::uint32_t>, std::size_t);

class Reductions : public testing::TestWithParam<Reduce> {};

// Six times the enclosed volume, which only holes and turned triangles change by much.
double volume6(const Surface& surface, const std::vector<std::uint32_t>& list) {
  double sum = 0;
  for (std::size_t i = 0; i < list.size(); i += 3) {
    const glm::dvec3 a(surface.points[list[i]]), b(surface.points[list[i + 1]]), c(surface.points[list[i + 2]]);
    sum += glm::dot(a, glm::cross(b, c));
  }
  return sum;
}

TEST_P(Reductions, ReachTheCountAndKeepTheShape) {
  const Surface surface = test::surface_of(test::wavy_sphere(4));
  const std::vector<std::uint32_t> full = full_list(surface);
  const std::size_t target = full.size() / 3 / 4;
  const std::vector<std::uint32_t> reduced = GetParam()(surface.points, full, target);
  EXPECT_LE(reduced.size() / 3, target);
  EXPECT_GE(reduced.size() / 3, target * 95 / 100);
  EXPECT_LT(*std::max_element(reduced.begin(), reduced.end()), surface.points.size());
  const double before = volume6(surface, full);
  EXPECT_NEAR(volume6(surface, reduced), before, 0.05 * before) << "half the vertices each way lie on the surface";
}

TEST_P(Reductions, TwoSidedTrianglesStayTwoSided) {
  const Surface surface = test::surface_of(test::cut_open(test::sphere(4), {0, 0, 1}, 0.1f));
  const std::vector<std::uint32_t> full = full_list(surface);
  const std::vector<std::uint32_t> reduced = GetParam()(surface.points, full, full.size() / 3 / 4);
  EXPECT_LE(reduced.size(), full.size() / 4);
  std::multiset<std::array<std::uint32_t, 3>> there;
  const auto rotated = [](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    std::array<std::uint32_t, 3> t{a, b, c};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
  };
  for (std::size_t i = 0; i < reduced.size(); i += 3) {
    there.insert(rotated(reduced[i], reduced[i + 1], reduced[i + 2]));
  }
  for (const auto& t : there) EXPECT_EQ(there.count(rotated(t[0], t[2], t[1])), there.count(t));
}

TEST_P(Reductions, NonManifoldMeshIsReducedWithoutAComplaint) {
  RINKAKU_NEEDS_DATA();
  const Surface surface = test::surface_from("meshes/dirty/mlab_non_manif_hole.ply");
  const std::vector<std::uint32_t> full = full_list(surface);
  testing::internal::CaptureStderr();
  const std::vector<std::uint32_t> reduced = GetParam()(surface.points, full, full.size() / 3 / 2);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_LT(reduced.size(), full.size() * 7 / 10) << "half, and what can't be collapsed";
  EXPECT_GT(reduced.size(), 0u);
}

INSTANTIATE_TEST_SUITE_P(All, Reductions, testing::Values(&reduce_with_meshopt, &reduce_with_quadrics),
                         [](const auto& which) { return which.index == 0 ? "Meshopt" : "Quadrics"; });

using Triangles = std::multiset<std::array<std::uint32_t, 3>>;

Triangles triangles_of(std::span<const std::uint32_t> list) {
  Triangles out;
  for (std::size_t i = 0; i < list.size(); i += 3) {
    std::array<std::uint32_t, 3> t{list[i], list[i + 1], list[i + 2]};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    out.insert(t);
  }
  return out;
}

TEST(ClusterCones, LeaveOutOnlyWhatFacesAway) {
  const Surface surface = test::surface_of(test::wavy_sphere(5));
  const std::vector<std::uint32_t> full = full_list(surface);
  ClusterCones cones(surface.points, full);
  const Triangles all = triangles_of(full);
  for (const glm::dvec3& eye : {glm::dvec3(0, 0, 2), glm::dvec3(3, 1, -1), glm::dvec3(-40, 30, 0)}) {
    const auto facing = cones.facing(eye);
    const Triangles left = triangles_of(facing);
    EXPECT_LT(left.size(), all.size());
    EXPECT_TRUE(std::includes(all.begin(), all.end(), left.begin(), left.end()));
    for (const auto& t : all) {
      const glm::dvec3 a(surface.points[t[0]]), b(surface.points[t[1]]), c(surface.points[t[2]]);
      const bool faces = glm::dot(glm::cross(b - a, c - a), eye - a) > 0;
      EXPECT_TRUE(!faces || left.count(t) == all.count(t));
    }
  }
}

class PeerMattes : public test::GlTest {};

// What region meshes are for: at the same count the others change the silhouette, or keep more triangles.
TEST_F(PeerMattes, DifferWhereRegionsDoNot) {
  const Surface surface = test::surface_of(test::wavy_sphere(5));
  BakeOptions options;
  options.space = RegionLayout{4, 1, 1.5};
  const RegionFile file = RegionFile::from_memory(bake(surface, options)->file, "baked.rgn");
  CheckView view;
  const glm::dvec3 eye(1, 2, 2);
  view.view.camera = camera_of({640, 480}, 0.8);
  view.view.camera_from_world = looking_at(surface.frame.to_mesh(eye), surface.frame.centre);
  MatteComparison comparison(surface);
  const std::vector<std::uint32_t>& full = comparison.full_indices();
  std::vector<std::uint32_t> list;
  file.decode(*RegionFinder(file.space()).find(eye), Product::Matte, list);
  EXPECT_EQ(comparison.compare(view, list).mismatch_px, 0);
  EXPECT_GT(comparison.compare(view, reduce_with_meshopt(surface.points, full, list.size() / 3)).mismatch_px, 0);
  EXPECT_GT(comparison.compare(view, reduce_with_quadrics(surface.points, full, list.size() / 3)).mismatch_px, 0);
  ClusterCones cones(surface.points, full);
  const auto facing = cones.facing(surface.frame.to_mesh(eye));
  EXPECT_EQ(comparison.compare(view, facing).mismatch_px, 0);
  EXPECT_GT(facing.size(), list.size());
}

}  // namespace
}  // namespace rinkaku::silhouette
