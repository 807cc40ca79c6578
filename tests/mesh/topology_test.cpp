#include "mesh/topology.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "mesh/import.h"
#include "tests/mesh/shapes.h"
#include "tests/support/test_data.h"

namespace rinkaku::mesh {
namespace {

using test::cube;
using test::one_part;
using test::sphere;
using test::square;

TEST(Topology, SphereIsClosedAndItsOutlineNormalsAreRadial) {
  const Mesh mesh = assemble(sphere(3), 60).mesh;
  const Topology t = topology(mesh);
  EXPECT_EQ(t.edges.size(), mesh.triangles.size() * 3 / 2);
  EXPECT_EQ(t.consistent_edges, t.edges.size());
  EXPECT_EQ(t.component_count, 1u);
  EXPECT_EQ(t.component_two_sided[0], 0);
  for (std::size_t p = 0; p < t.points.size(); ++p) {
    EXPECT_LT(glm::distance(t.outline_normals[p], t.points[p]), 0.03) << "edges are 0.2 long; off by their square";
  }
}

TEST(Topology, OutlineNormalsOfACubeAreItsDiagonalsThoughItsShadingIsHard) {
  const Mesh mesh = assemble(cube(), 60).mesh;
  ASSERT_EQ(mesh.positions.size(), 24u);
  const Topology t = topology(mesh);
  EXPECT_EQ(t.edges.size(), 18u);
  for (std::size_t p = 0; p < t.points.size(); ++p) {
    EXPECT_NEAR(glm::distance(t.outline_normals[p], glm::normalize(t.points[p])), 0, 1e-6);
  }
}

TEST(Topology, EdgesNameTheVerticesOfTheirFirstFace) {
  const Mesh mesh = assemble(cube(), 60).mesh;
  const Topology t = topology(mesh);
  for (const Edge& e : t.edges) {
    EXPECT_EQ(mesh.welded[e.vertex_a], e.a);
    EXPECT_EQ(mesh.welded[e.vertex_b], e.b);
    const glm::uvec3& face = mesh.triangles[e.face0];
    bool runs = false;
    for (int c = 0; c < 3; ++c) runs = runs || (face[c] == e.vertex_a && face[(c + 1) % 3] == e.vertex_b);
    EXPECT_TRUE(runs);
  }
}

TEST(Topology, BordersPointOutOfTheSurface) {
  const Mesh mesh = assemble(square(), 60).mesh;
  const Topology t = topology(mesh);
  EXPECT_EQ(t.boundary_edges, 4u);
  EXPECT_EQ(t.component_two_sided[0], 1);
  for (std::size_t p = 0; p < t.points.size(); ++p) {
    const glm::vec3 corner = t.points[p];
    const glm::vec3 outward = glm::normalize(glm::vec3(corner.x - 0.5f, corner.y - 0.5f, 0));
    EXPECT_NEAR(glm::distance(t.outline_normals[p], outward), 0, 1e-6);
  }
}

TEST(Topology, DisagreeingWindingsAreFoundAndOutlineNormalsStillPointOutwards) {
  Soup soup = sphere(3);
  for (std::size_t f = 0; f < soup.triangles.size(); f += 3) std::swap(soup.triangles[f].y, soup.triangles[f].z);
  const Mesh mesh = assemble(std::move(soup), 60).mesh;
  const Topology t = topology(mesh);
  EXPECT_GT(t.inconsistent_edges, 0u);
  EXPECT_EQ(t.boundary_edges, 0u);
  EXPECT_EQ(t.component_two_sided[0], 1);
  for (std::size_t f = 0; f < t.faces.size(); ++f) {
    const bool inward = glm::dot(t.face_normals[f], t.points[t.faces[f].x]) < 0;
    EXPECT_EQ(t.turned[f] != 0, inward);
  }
  for (std::size_t p = 0; p < t.points.size(); ++p) EXPECT_LT(glm::distance(t.outline_normals[p], t.points[p]), 0.03);
}

TEST(Topology, EdgeOfThreeFacesListsThemAll) {
  Soup soup;  // three fins on one edge
  soup.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}};
  soup.triangles = {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}};
  const Mesh mesh = assemble(one_part(std::move(soup)), 60).mesh;
  const Topology t = topology(mesh);
  ASSERT_EQ(t.non_manifold_edges, 1u);
  EXPECT_EQ(t.boundary_edges, 6u);
  const auto faces = t.edge_faces(static_cast<std::uint32_t>(t.edges.size() - 1));
  ASSERT_EQ(faces.size(), 3u);
  EXPECT_EQ(std::count_if(faces.begin(), faces.end(), [](const EdgeFace& f) { return f.reversed; }) % 3, 1)
      << "two run one way, one the other; the first face's way is not reversed, whichever came first";
  EXPECT_TRUE(t.edge_faces(0).empty());
}

TEST(Topology, ComponentsAreJudgedOneByOne) {
  Soup soup = sphere(2);
  const auto first = static_cast<std::uint32_t>(soup.positions.size());
  for (const glm::vec3& p : square().positions) soup.positions.push_back(p + glm::vec3(5, 0, 0));
  for (const glm::uvec3& f : square().triangles) soup.triangles.push_back(f + first);
  const Mesh mesh = assemble(one_part(std::move(soup)), 60).mesh;
  const Topology t = topology(mesh);
  ASSERT_EQ(t.component_count, 2u);
  for (std::size_t f = 0; f < t.faces.size(); ++f) {
    EXPECT_EQ(t.component_two_sided[t.component[f]] != 0, t.points[t.faces[f].x].x > 3);
  }
}

TEST(Topology, NothingIsNotANumberOnRealMeshes) {
  RINKAKU_NEEDS_DATA();
  for (const char* file :
       {"dirty/mlab_office_chair.obj", "dirty/gc_moebius.obj", "dirty/assimp_spider.obj", "dirty/cgal_boeing_soup.off",
        "dirty/mlab_conrod_badwinding.stl", "closed/oded_spot_23k.obj"}) {
    const Topology t = topology(import(test::data(std::string("meshes/") + file)).mesh);
    for (const glm::vec3& n : t.outline_normals) ASSERT_NEAR(glm::length(n), 1, 1e-5) << file;
    for (const glm::vec3& n : t.face_normals) ASSERT_TRUE(std::isfinite(n.x + n.y + n.z)) << file;
  }
}

}  // namespace
}  // namespace rinkaku::mesh
