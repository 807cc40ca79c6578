#include "silhouette/reduce.h"

#include <map>

#include <gtest/gtest.h>

#include "silhouette/classify.h"
#include "tests/silhouette/raster.h"
#include "tests/silhouette/surfaces.h"

namespace rinkaku::silhouette {
namespace {

using test::eye_in;
using test::surface_from;
using test::surface_of;

std::vector<std::uint32_t> matte_list(const Surface& surface, const RegionMeshes& meshes) {
  const auto silhouette = triangles_of(surface, meshes, Role::Silhouette);
  EXPECT_EQ(silhouette.size(), meshes.silhouette);
  std::vector<std::uint32_t> out;
  for (const auto* list : {&silhouette, &meshes.matte_front}) {
    for (const glm::uvec3& t : *list) out.insert(out.end(), {t.x, t.y, t.z});
  }
  return out;
}

/// Directed edges that no triangle runs through the other way, with how often: a mesh's boundary.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> boundary(const std::vector<glm::uvec3>& triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const glm::uvec3& t : triangles) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i];
      const std::uint32_t b = t[(i + 1) % 3];
      a < b ? ++edges[{a, b}] : --edges[{b, a}];
    }
  }
  std::erase_if(edges, [](const auto& e) { return e.second == 0; });
  return edges;
}

/// The front mesh before it was collapsed.
std::vector<glm::uvec3> front_of(const Surface& surface, const ViewRegion& region) {
  std::vector<Side> sides;
  classify(triangle_planes(surface), region, sides);
  std::vector<glm::uvec3> out;
  for (std::size_t t = 0; t < sides.size(); ++t) {
    const glm::uvec3& v = surface.triangles[t];
    if (sides[t] == Side::Front) out.push_back(v);
    if (sides[t] == Side::Back && surface.two_sided[t]) out.emplace_back(v.x, v.z, v.y);
  }
  return out;
}

void front_mesh_is_right(const Surface& surface, const RegionLayout& layout) {
  Reducer reducer(surface);
  RegionMeshes meshes;
  std::size_t front = 0;
  std::size_t least = 0;
  for (std::uint32_t r = 0; r < region_count(layout); ++r) {
    const ViewRegion region = view_region(layout, r);
    reducer.reduce(region, {}, meshes);
    const auto before = front_of(surface, region);
    EXPECT_EQ(meshes.front_before, before.size());
    EXPECT_EQ(boundary(meshes.matte_front), boundary(before)) << "region " << r;
    for (const glm::uvec3& t : meshes.matte_front) {
      const glm::dvec3 a = surface.frame.to_unit(surface.points[t.x]);
      const glm::dvec3 ab = surface.frame.to_unit(surface.points[t.y]) - a;
      const glm::dvec3 ac = surface.frame.to_unit(surface.points[t.z]) - a;
      const glm::dvec3 normal = glm::cross(ab, ac);
      const double longest_sq = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(ac - ab, ac - ab)});
      for (const glm::dvec4& h : region.hull) {
        // The rule takes the distance from one of the corners; rounding is all that may be between.
        double seen = 0;
        for (const glm::dvec3& corner : {a, a + ab, a + ac}) {
          const glm::dvec3 way = glm::dvec3(h) - h.w * corner;
          seen = std::max(seen, glm::dot(normal, way) / (longest_sq * glm::length(way)));
        }
        ASSERT_GE(seen, kFlattest * (1 - 1e-9));
      }
    }
    front += meshes.matte_front.size();
    least += meshes.front_least;
  }
  EXPECT_GE(front, least);
  EXPECT_LE(double(front), 1.05 * double(least)) << "the aim set for it";
}

TEST(Reduce, FrontMeshKeepsItsBoundaryFacesTheHullAndIsNearlyMinimal) {
  front_mesh_is_right(surface_of(test::wavy_sphere(5)), {2, 2, 1.5});
}

TEST(Reduce, TwoSidedFrontMeshesToo) {
  front_mesh_is_right(surface_of(test::cut_open(test::wavy_sphere(5), {0, 0.6f, 0.8f}, 0.3f)), {2, 1, 1.5});
  front_mesh_is_right(surface_of(test::moebius(160, 8)), {2, 1, 1.5});
}

TEST(Reduce, RealMeshesToo) {
  RINKAKU_NEEDS_DATA();
  front_mesh_is_right(surface_from("meshes/closed/cgal_cheese_genus133.off"), {2, 1, 1.5});
  front_mesh_is_right(surface_from("meshes/dirty/mlab_office_chair.obj"), {2, 1, 1.5});
}

/// Compares mattes from eyes all over some regions: inside, and on hull vertices and edges.
void mattes_are_equal(const Surface& surface, const RegionLayout& layout, std::uint32_t every) {
  Reducer reducer(surface);
  RegionMeshes meshes;
  const auto full = full_list(surface);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> aside(-0.3, 0.3);
  std::size_t triangles = 0;
  std::size_t regions = 0;
  for (std::uint32_t r = 0; r < region_count(layout); r += every) {
    const ViewRegion region = view_region(layout, r);
    reducer.reduce(region, {0, r % 3 != 0}, meshes);
    const auto list = matte_list(surface, meshes);
    triangles += list.size() / 3;
    ++regions;
    std::vector<glm::dvec3> eyes{eye_in(region, random), eye_in(region, random), glm::dvec3(region.hull[0]),
                                 glm::dvec3(region.hull[0] + region.hull[1]) / 2.0};
    for (const glm::dvec3& eye : eyes) {
      const glm::dvec3 target(aside(random), aside(random), aside(random));
      const test::Raster raster(300, surface.frame.to_mesh(eye), surface.frame.to_mesh(target),
                                2.2 / std::max(1.2, glm::length(eye)));
      const auto expected = raster.coverage(surface.points, full);
      ASSERT_EQ(test::differing(raster.coverage(surface.points, list), expected), 0) << "region " << r;
      EXPECT_NE(test::differing(expected, std::vector<std::uint8_t>(expected.size(), 0)), 0);
    }
  }
  EXPECT_LT(triangles / regions, full.size() / 3 * 6 / 10) << "nothing was reduced";
}

TEST(Reduce, MatteCoversTheSamePixelsAsTheWholeMesh) {
  mattes_are_equal(surface_of(test::wavy_sphere(5)), {4, 2, 1.5}, 5);
}

/// A sphere with a small one before it, in the middle of the region's view.
test::Soup sphere_before_sphere() {
  test::Soup soup = test::sphere(4);
  const test::Soup small = test::sphere(3);
  const auto first = static_cast<std::uint32_t>(soup.positions.size());
  for (const glm::vec3& p : small.positions) soup.positions.push_back(p * 0.1f + glm::vec3(1.2f, 0.05f, 0.05f));
  for (const glm::uvec3& t : small.triangles) soup.triangles.push_back(t + first);
  return test::one_part(std::move(soup));
}

TEST(Reduce, MatteLeavesOutWhatTheFrontMeshHides) {
  const Surface surface = surface_of(sphere_before_sphere());
  Reducer reducer(surface);
  RegionMeshes whole;
  RegionMeshes meshes;
  const RegionLayout layout{16, 1, 1.5};
  const ViewRegion region = view_region(layout, *RegionFinder(layout).find({3, 0.3, 0.3}));
  reducer.reduce(region, {0.01, false}, whole);
  reducer.reduce(region, {0.01, true}, meshes);
  EXPECT_EQ(whole.hidden, 0u);
  EXPECT_EQ(whole.silhouette, meshes.silhouette + meshes.hidden);
  EXPECT_EQ(whole.depth_front, meshes.depth_front);
  // The small sphere's contour lies before the large one's front mesh from every eye, the large one's own before
  // nothing.
  std::size_t of_small = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const bool small = surface.points[surface.triangles[t].x].x > 1.05f;
    if (small) {
      EXPECT_NE(meshes.roles[t], Role::Silhouette);
      of_small += meshes.roles[t] == Role::Hidden;
    } else {
      EXPECT_NE(meshes.roles[t], Role::Hidden);
    }
  }
  EXPECT_GT(of_small, 50u);
}

TEST(Reduce, MatteWithoutHiddenTrianglesIsTheSame) {
  mattes_are_equal(surface_of(sphere_before_sphere()), {6, 1, 1.5}, 2);
}

TEST(Reduce, MatteOfAnOpenMeshHasNoHoles) {
  mattes_are_equal(surface_of(test::cut_open(test::wavy_sphere(5), {0, 0.6f, 0.8f}, 0.3f)), {4, 1, 1.5}, 5);
  mattes_are_equal(surface_of(test::moebius(160, 8)), {4, 1, 1.5}, 5);
}

TEST(Reduce, MattesOfRealMeshesAreEqual) {
  RINKAKU_NEEDS_DATA();
  mattes_are_equal(surface_from("meshes/closed/oded_spot_23k.obj"), {8, 1, 1.5}, 37);
  mattes_are_equal(surface_from("meshes/dirty/mlab_office_chair.obj"), {8, 1, 1.5}, 29);
  mattes_are_equal(surface_from("meshes/dirty/cgal_boeing_soup.off"), {8, 1, 1.5}, 29);
  mattes_are_equal(surface_from("meshes/dirty/mlab_conrod_badwinding.stl"), {8, 1, 1.5}, 29);
  mattes_are_equal(surface_from("meshes/open/cgal_lion-head_17k.off"), {8, 1, 1.5}, 37);
}

TEST(Reduce, ColourKeepsAllThatCanShowInOrder) {
  const Surface surface = surface_of(test::wavy_sphere(4));
  const ViewRegion region = view_region(RegionLayout{4, 1, 1.5}, 30);
  RegionMeshes meshes;
  Reducer(surface).reduce(region, {}, meshes);
  std::vector<Side> sides;
  classify(triangle_planes(surface), region, sides);
  std::size_t kept = 0;
  for (std::size_t t = 0; t < sides.size(); ++t) {
    const bool marked = can_show(surface, meshes, t);
    EXPECT_EQ(marked, sides[t] != Side::Back);
    kept += marked;
  }
  EXPECT_LT(kept, sides.size() * 8 / 10);
}

TEST(Reduce, ColourDropsNothingThatIsSeenFromBehind) {
  const Surface surface = surface_of(test::cut_open(test::wavy_sphere(3), {0, 0, 1}, 0.3f));
  RegionMeshes meshes;
  Reducer(surface).reduce(view_region(RegionLayout{4, 1, 1.5}, 30), {}, meshes);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) EXPECT_TRUE(can_show(surface, meshes, t));
}

TEST(Reduce, SameRegionGivesTheSameWhateverCameBefore) {
  const Surface surface = surface_of(test::wavy_sphere(4));
  const RegionLayout layout{4, 1, 1.5};
  RegionMeshes first;
  RegionMeshes again;
  Reducer fresh(surface);
  fresh.reduce(view_region(layout, 11), {0.01, true}, first);
  Reducer used(surface);
  for (const std::uint32_t r : {90u, 3u, 11u}) used.reduce(view_region(layout, r), {0.01, true}, again);
  EXPECT_EQ(again.roles, first.roles);
  EXPECT_EQ(again.matte_front, first.matte_front);
  EXPECT_EQ(again.depth_front, first.depth_front);
}

}  // namespace
}  // namespace rinkaku::silhouette
