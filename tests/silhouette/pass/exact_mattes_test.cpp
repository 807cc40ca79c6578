// Region mattes against the whole mesh's, to the last pixel. `rinkaku verify` does the same with thousands of eyes.
#include <algorithm>

#include "silhouette/bake.h"
#include "silhouette/verify/matte_comparison.h"
#include "silhouette/verify/verify.h"
#include "tests/pipeline/passes/gl_test.h"
#include "tests/silhouette/surfaces.h"

namespace rinkaku::silhouette {
namespace {

class ExactMattes : public test::GlTest {
 protected:
  static RegionFile baked(const Surface& surface, const ViewSpace& space) {
    BakeOptions options;
    options.space = space;
    return RegionFile::from_memory(bake(surface, options)->file, "baked.rgn");
  }

  // No pixel differs in `eyes` eyes, most of which see a silhouette.
  static void expect_exact(const Surface& surface, std::uint64_t eyes, const ViewSpace& space = RegionLayout{4, 1, 1.5},
                           std::uint64_t seed = 1) {
    VerifyOptions options;
    options.eyes = eyes;
    options.views.seed = seed;
    options.views.size_px = {640, 480};
    const VerifyReport report = verify(baked(surface, space), surface, options);
    EXPECT_EQ(report.eyes, eyes);
    EXPECT_GT(report.eyes_with_edges, eyes / 2);
    EXPECT_EQ(report.mismatch_px_total, 0);
    for (const Mismatch& m : report.mismatches) ADD_FAILURE() << m.pixels << " px, " << m.description;
  }
};

TEST_F(ExactMattes, Sphere) { expect_exact(test::surface_of(test::sphere(4)), 100); }
TEST_F(ExactMattes, LayersOverEachOther) { expect_exact(test::surface_of(test::wavy_sphere(5)), 100); }
TEST_F(ExactMattes, CubeWithNothingToCollapse) { expect_exact(test::surface_of(test::cube()), 50); }
TEST_F(ExactMattes, OpenSurface) {
  expect_exact(test::surface_of(test::cut_open(test::wavy_sphere(4), {0.3f, 0.8f, 0.5f}, 0.2f)), 100);
}
TEST_F(ExactMattes, FlatSheetSeenEdgeOn) { expect_exact(test::surface_of(test::square()), 50); }
TEST_F(ExactMattes, OneSidedSurface) { expect_exact(test::surface_of(test::moebius(60, 6)), 60); }
TEST_F(ExactMattes, TurnedTriangles) {
  expect_exact(test::surface_of(test::shuffled_winding(test::wavy_sphere(4), 5)), 60);
}
TEST_F(ExactMattes, SeveralShells) {
  expect_exact(test::surface_of(test::wavy_sphere(4)), 60, RegionLayout{3, 3, 1.2}, 2);
}
TEST_F(ExactMattes, ExplicitRegion) {
  ViewRegion box;
  for (int i = 0; i < 8; ++i) box.hull.emplace_back(i & 1 ? 2.5 : 1.6, i & 2 ? 0.7 : -0.4, i & 4 ? 0.5 : -0.6, 1);
  expect_exact(test::surface_of(test::wavy_sphere(4)), 60, box);
}

TEST_F(ExactMattes, RealMeshes) {
  RINKAKU_NEEDS_DATA();
  for (const char* file :
       {"meshes/closed/oded_fish_1k9.obj", "meshes/closed/oded_torus_4k6.obj", "meshes/open/pmp_hemisphere_3k6.off",
        "meshes/dirty/gc_moebius.obj", "meshes/dirty/trimesh_soup.stl", "meshes/dirty/cgal_boeing_soup.off",
        "meshes/dirty/assimp_spider.obj", "meshes/dirty/mlab_non_manif_hole.ply",
        "meshes/dirty/cgal_blobby_shuffled_winding.off"}) {
    SCOPED_TRACE(file);
    expect_exact(test::surface_from(file), 40);
  }
}

// Winding is not relied on here: every triangle of the mesh as it came, from both sides.
TEST_F(ExactMattes, WholeListCoversWhatTheMeshAsItCameCovers) {
  const test::Soup soups[] = {test::wavy_sphere(4), test::shuffled_winding(test::wavy_sphere(4), 3),
                              test::moebius(60, 6), test::cut_open(test::sphere(4), {0, 0, 1}, 0.1f), test::cube()};
  for (const test::Soup& soup : soups) {
    const Surface surface = test::surface_of(soup);
    std::vector<std::uint32_t> both;
    for (const glm::uvec3& t : surface.triangles) both.insert(both.end(), {t.x, t.y, t.z, t.x, t.z, t.y});
    MatteComparison comparison(surface);
    CheckViews views(RegionLayout{}, surface.frame, {.seed = 3, .size_px = glm::ivec2(640, 480)});
    for (std::uint64_t eye = 0; eye < 20; ++eye) {
      const CheckView view = views.view(eye);
      if (view.description.find("eye's plane") != std::string::npos) continue;  // cut open: the inside shows
      EXPECT_EQ(comparison.compare(view, both).mismatch_px, 0) << view.description;
    }
  }
}

TEST_F(ExactMattes, ComparisonNoticesAMissingTriangleAndAnotherRegionsList) {
  const Surface surface = test::surface_of(test::wavy_sphere(3));
  const ViewSpace space = RegionLayout{4, 1, 1.5};
  const RegionFile file = baked(surface, space);
  CheckView view;
  const glm::dvec3 eye(0, 0, 3);
  view.view.camera = camera_of({640, 480}, 0.8);
  view.view.camera_from_world = looking_at(surface.frame.to_mesh(eye), surface.frame.centre);
  MatteComparison comparison(surface);

  std::vector<std::uint32_t> list;
  file.decode(*RegionFinder(space).find(eye), Product::Matte, list);
  EXPECT_EQ(comparison.compare(view, list).mismatch_px, 0);
  // Some triangle of the list covers pixels that no other does.
  std::int64_t most = 0;
  for (std::size_t left_out = 0; left_out < list.size() && most == 0; left_out += 3) {
    std::vector<std::uint32_t> shorter = list;
    shorter.erase(shorter.begin() + static_cast<std::ptrdiff_t>(left_out),
                  shorter.begin() + static_cast<std::ptrdiff_t>(left_out) + 3);
    most = comparison.compare(view, shorter).mismatch_px;
  }
  EXPECT_GT(most, 0);
  file.decode(*RegionFinder(space).find(-eye), Product::Matte, list);
  EXPECT_GT(comparison.compare(view, list).mismatch_px, 1000) << "the object's far side, from behind";
}

TEST_F(ExactMattes, FileOfAnotherMeshIsRefused) {
  const Surface one = test::surface_of(test::sphere(2)), other = test::surface_of(test::sphere(3));
  EXPECT_THROW(verify(baked(one, RegionLayout{1, 1, 1.5}), other, {}), Error);
}

}  // namespace
}  // namespace rinkaku::silhouette
