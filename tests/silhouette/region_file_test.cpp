#include "silhouette/region_file.h"

#include <algorithm>
#include <fstream>

#include <gtest/gtest.h>

#include "pipeline/frame/error.h"
#include "silhouette/bake.h"
#include "tests/silhouette/surfaces.h"

namespace rinkaku::silhouette {
namespace {

using test::surface_of;

BakeOptions with_depth() {
  BakeOptions options;
  options.space = RegionLayout{2, 1, 1.5};
  options.reduce.depth_distance = 0.01;
  return options;
}

using Triangles = std::vector<std::vector<std::uint32_t>>;

/// Triangles each from its least corner on, sorted: the same for any order and start.
Triangles sorted(std::span<const std::uint32_t> indices) {
  Triangles out;
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    std::vector<std::uint32_t> t(indices.begin() + i, indices.begin() + i + 3);
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    out.push_back(t);
  }
  std::sort(out.begin(), out.end());
  return out;
}

Triangles sorted(std::initializer_list<const std::vector<glm::uvec3>*> lists) {
  std::vector<std::uint32_t> indices;
  for (const auto* list : lists) {
    for (const glm::uvec3& t : *list) indices.insert(indices.end(), {t.x, t.y, t.z});
  }
  return sorted(indices);
}

void holds_what_was_reduced(const Surface& surface) {
  const BakeOptions options = with_depth();
  const RegionFile file = RegionFile::from_memory(bake(surface, options)->file, "baked");
  file.must_belong_to(surface);
  Reducer reducer(surface);
  RegionMeshes meshes;
  std::vector<std::uint32_t> list;
  ASSERT_EQ(file.regions(), 24u);
  for (std::uint32_t r = 0; r < file.regions(); ++r) {
    reducer.reduce(view_region(options.space, r), options.reduce, meshes);
    const auto silhouette = triangles_of(surface, meshes, Role::Silhouette);
    const auto hidden = triangles_of(surface, meshes, Role::Hidden);
    file.decode(r, Product::Matte, list);
    EXPECT_EQ(list.size(), 3 * std::size_t{file.triangles(r, Product::Matte)});
    EXPECT_EQ(sorted(list), sorted({&silhouette, &meshes.matte_front}));
    file.decode(r, Product::Depth, list);
    EXPECT_EQ(list.size(), 3 * std::size_t{file.triangles(r, Product::Depth)});
    EXPECT_EQ(sorted(list), sorted({&silhouette, &hidden, &meshes.depth_front}));
    file.decode_colour(r, surface.triangles, list);
    EXPECT_EQ(list.size(), 3 * std::size_t{file.triangles(r, Product::Colour)});
    std::vector<std::uint32_t> kept;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      const glm::uvec3& v = surface.triangles[t];
      if (can_show(surface, meshes, t)) kept.insert(kept.end(), {v.x, v.y, v.z});
    }
    EXPECT_EQ(list, kept) << "in the mesh's order";
  }
}

TEST(RegionFile, HoldsWhatWasReduced) { holds_what_was_reduced(surface_of(test::wavy_sphere(4))); }

TEST(RegionFile, HoldsBothWindingsOfTwoSidedParts) {
  holds_what_was_reduced(surface_of(test::cut_open(test::wavy_sphere(4), {0, 0, 1}, 0.2f)));
}

TEST(RegionFile, TellsWhatItWasBakedFor) {
  const Surface surface = surface_of(test::cut_open(test::sphere(3), {0, 0, 1}, 0.2f));
  BakeOptions options;
  ViewRegion box;
  for (int i = 0; i < 8; ++i) box.hull.emplace_back(i & 1 ? 3 : 2, i & 2 ? 1 : -1, i & 4 ? 1 : -1, 1);
  options.space = box;
  const RegionFile file = RegionFile::from_memory(bake(surface, options)->file, "baked");
  EXPECT_EQ(file.regions(), 1u);
  EXPECT_EQ(std::get<ViewRegion>(file.space()).hull, box.hull);
  EXPECT_EQ(file.points(), surface.points.size());
  EXPECT_EQ(file.mesh_triangles(), surface.triangles.size());
  EXPECT_EQ(file.full_triangles(), 2 * surface.triangles.size());
  EXPECT_EQ(file.frame().centre, surface.frame.centre);
  EXPECT_EQ(file.frame().radius, surface.frame.radius);
  EXPECT_FALSE(file.has_depth());
  std::vector<std::uint32_t> list;
  EXPECT_THROW(file.decode(0, Product::Depth, list), Error);
}

TEST(RegionFile, TakesAtMostTwoBytesATriangle) {
  const Surface surface = surface_of(test::wavy_sphere(6));
  BakeOptions options;
  options.space = RegionLayout{2, 1, 1.5};
  const auto baked = bake(surface, options);
  EXPECT_LE(baked->report.bytes, 2 * baked->report.triangles_stored);
}

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_status(), 2);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "";
}

TEST(RegionFile, AnotherMeshsFileIsRefused) {
  const RegionFile file = RegionFile::from_memory(bake(surface_of(test::sphere(2)), with_depth())->file, "a.rgn");
  test::Soup moved = test::sphere(2);
  moved.positions[0].x += 1e-3f;
  const Surface other = surface_of(moved);
  EXPECT_NE(refusal([&] { file.must_belong_to(other); }).find("another mesh"), std::string::npos);
}

TEST(RegionFile, WhatIsNoRegionFileIsRefused) {
  const test::TemporaryFolder folder;
  const auto open = [&](const std::string& content) {
    std::ofstream(folder / "x.rgn") << content;
    return refusal([&] { RegionFile::open(folder / "x.rgn"); });
  };
  EXPECT_NE(open("").find("is empty"), std::string::npos);
  EXPECT_NE(open("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").find("is no region file"), std::string::npos);
  EXPECT_NE(refusal([&] { RegionFile::open(folder / "absent.rgn"); }).find("absent.rgn"), std::string::npos);
  EXPECT_NE(refusal([&] { RegionFile::open(folder.path()); }).find("is no file"), std::string::npos);
}

/// Opens it and decodes all of it.
std::string refusal_of_all(const std::vector<std::uint8_t>& bytes) {
  return refusal([&] {
    const RegionFile file = RegionFile::from_memory(bytes, "x.rgn");
    std::vector<std::uint32_t> list;
    for (std::uint32_t r = 0; r < file.regions(); ++r) file.decode(r, Product::Matte, list);
  });
}

TEST(RegionFile, CutShortFilesAreRefused) {
  const auto bytes = bake(surface_of(test::sphere(2)), with_depth())->file;
  EXPECT_EQ(refusal_of_all(bytes), "");
  for (std::size_t size = 0; size < bytes.size(); size += size < 200 ? 1 : 97) {
    EXPECT_NE(refusal_of_all({bytes.begin(), bytes.begin() + size}), "") << size << " of " << bytes.size();
  }
}

TEST(RegionFile, EveryDamagedByteThatMattersIsNoticed) {
  const auto bytes = bake(surface_of(test::sphere(2)), with_depth())->file;
  std::size_t unnoticed = 0;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    auto damaged = bytes;
    damaged[at] ^= 0x10;
    if (refusal_of_all(damaged).empty()) ++unnoticed;
  }
  // Padding between fields, and offsets that are not followed.
  EXPECT_LE(unnoticed, 64u) << "of " << bytes.size();
}

}  // namespace
}  // namespace rinkaku::silhouette
