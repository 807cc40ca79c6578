#include "silhouette/region_faces.h"

#include <gtest/gtest.h>

#include "mesh/contour.h"
#include "silhouette/bake.h"
#include "tests/silhouette/surfaces.h"

namespace rinkaku::silhouette {
namespace {

template <typename T>
std::vector<T> copy(std::span<const T> values) {
  return {values.begin(), values.end()};
}

// Eyes of all regions, and of the inner radius, where nothing is known.
void expect_the_same_found(mesh::Soup soup) {
  const mesh::Mesh mesh = mesh::assemble(std::move(soup), 60).mesh;
  const mesh::Topology topology = mesh::topology(mesh);
  const Surface surface = make_surface(mesh, topology);
  BakeOptions options;
  options.space = RegionLayout{3, 2, 1.5};
  const auto file = std::make_shared<const RegionFile>(RegionFile::from_memory(bake(surface, options)->file, "baked"));
  RegionListsOptions at_once;
  at_once.decode_at_once = true;
  RegionFaces faces(file, topology, at_once);
  mesh::ContourFinder alone(mesh, topology), helped(mesh, topology);
  std::mt19937 random(7);
  std::uint32_t known_of = 0;
  std::size_t doubtful = 0;
  for (std::uint32_t r = 0; r < file->regions(); ++r) {
    for (int i = 0; i < 4; ++i) {
      const glm::dvec3 unit_eye =
          i == 3 ? glm::dvec3(0.3, 0.2, 1.1) : test::eye_in(view_region(options.space, r), random);
      const glm::dvec3 eye = surface.frame.to_mesh(unit_eye);
      const mesh::KnownFaces* known = faces.at(eye);
      const mesh::Contour& expected = alone.find(eye);
      const mesh::Contour& found = helped.find(eye, {}, known);
      ASSERT_EQ(copy(found.front), copy(expected.front)) << "region " << r;
      ASSERT_EQ(copy(found.edges), copy(expected.edges)) << "region " << r;
      ASSERT_EQ(copy(found.front_indices), copy(expected.front_indices)) << "region " << r;
      if (known == nullptr) continue;
      ++known_of;
      doubtful += known->doubtful.size();
    }
  }
  EXPECT_GE(known_of, file->regions() * 3 * 9 / 10) << "eyes are in regions, a few inside the inner radius";
  EXPECT_LT(doubtful, known_of * mesh.triangles.size() * 0.9) << "something is known";
}

TEST(RegionFaces, ContourOfAClosedSurfaceIsTheSame) { expect_the_same_found(test::wavy_sphere(4)); }

TEST(RegionFaces, ContourIsTheSameWhereOnePartIsOpenAndWoundAnyhow) {
  mesh::Soup soup = test::wavy_sphere(4);
  const mesh::Soup open = test::shuffled_winding(test::cut_open(test::sphere(3), {0, 0, 1}, 0.2f), 3);
  const auto first = static_cast<std::uint32_t>(soup.positions.size());
  for (const glm::vec3& p : open.positions) soup.positions.push_back(p * 0.3f + glm::vec3(1.2f, 0, 0));
  for (const glm::uvec3& t : open.triangles) soup.triangles.push_back(t + first);
  expect_the_same_found(test::one_part(std::move(soup)));
}

}  // namespace
}  // namespace rinkaku::silhouette
