#include "mesh/contour.h"

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include <glm/geometric.hpp>

#include "mesh/bounds.h"
#include "mesh/import.h"
#include "tests/mesh/shapes.h"
#include "tests/support/test_data.h"

namespace rinkaku::mesh {
namespace {

using test::sphere;
using test::square;

/// Eyes all around, from inside the mesh to far away, and directions.
std::vector<glm::dvec4> eyes_around(const Mesh& mesh, int count) {
  const Sphere ball = bounding_sphere(mesh.positions);
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<glm::dvec4> eyes;
  const double distances[] = {0.3, 1.1, 3, 30, 1e5};
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 towards = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    if (i % 6 == 5) {
      eyes.emplace_back(towards, 0.0);
    } else {
      eyes.emplace_back(ball.centre + towards * ball.radius * distances[i % 6], 1.0);
    }
  }
  return eyes;
}

/// Which side of its plane the eye is on, in double; the sine of the angle to the line of sight, about.
double side(const Topology& t, std::size_t face, const glm::dvec4& eye) {
  const glm::dvec3 a(t.points[t.faces[face].x]);
  const glm::dvec3 n = glm::cross(glm::dvec3(t.points[t.faces[face].y]) - a, glm::dvec3(t.points[t.faces[face].z]) - a);
  const glm::dvec3 towards = glm::dvec3(eye) - eye.w * a;
  const double scale = glm::length(n) * glm::length(towards);
  return scale > 0 ? glm::dot(n, towards) / scale : 0;
}

/// Checks one eye against a plain search in double. Faces seen edge-on within float's precision may fall either way.
void expect_agrees(const Mesh& mesh, const Topology& t, const Contour& found, const glm::dvec4& eye) {
  constexpr double kFloat = 5e-6;  // unit normals and scaled eyes in float, three products: under 20 roundings
  const Sphere ball = bounding_sphere(mesh.positions);
  // Distances are judged against the whole mesh, so from within it small angles are coarser.
  std::vector<int> facing(t.faces.size());
  for (std::size_t f = 0; f < facing.size(); ++f) {
    const glm::dvec3 towards = glm::dvec3(eye) - eye.w * glm::dvec3(t.points[t.faces[f].x]);
    const double coarser = std::max(1.0, eye.w * ball.radius / std::max(glm::length(towards), 1e-12));
    const double s = side(t, f, eye);
    facing[f] = s > kFloat * coarser ? 1 : s < -kFloat * coarser ? -1 : 0;
    if (facing[f] != 0) {
      ASSERT_EQ(found.front[f], facing[f] > 0 ? 1 : 0) << "face " << f;
    }
  }

  const std::set<std::uint32_t> listed(found.edges.begin(), found.edges.end());
  ASSERT_EQ(listed.size(), found.edges.size()) << "no edge twice";
  for (std::uint32_t e = 0; e < t.edges.size(); ++e) {
    std::vector<EdgeFace> faces(t.edge_faces(e).begin(), t.edge_faces(e).end());
    const Edge& edge = t.edges[e];
    if (faces.empty()) faces.push_back({edge.face0, false});
    if (faces.size() == 1 && edge.face1 != kNone)
      faces.push_back({edge.face1, (edge.flags & Edge::kInconsistent) == 0});
    bool left = false;
    bool right = false;
    bool doubtful = false;
    for (const EdgeFace& f : faces) {
      doubtful = doubtful || facing[f.face] == 0;
      ((facing[f.face] > 0) != f.reversed ? left : right) = true;
    }
    if (!doubtful) {
      ASSERT_EQ(listed.count(e), left != right ? 1u : 0u) << "edge " << e << " of " << faces.size();
    }
  }
}

class ContourOfRealMesh : public testing::TestWithParam<const char*> {};

TEST_P(ContourOfRealMesh, AgreesWithAPlainSearchInDouble) {
  RINKAKU_NEEDS_DATA();
  const Mesh mesh = import(test::data(std::string("meshes/") + GetParam())).mesh;
  const Topology t = topology(mesh);
  ContourFinder finder(mesh, t);
  for (const glm::dvec4& eye : eyes_around(mesh, 30)) {
    expect_agrees(mesh, t, finder.find(eye), eye);
    if (HasFatalFailure()) return;
  }
}
INSTANTIATE_TEST_SUITE_P(Meshes, ContourOfRealMesh,
                         testing::Values("closed/oded_spot_23k.obj", "closed/cgal_elephant_5k6.off",
                                         "closed/cgal_cheese_genus133.off", "open/cgal_lion-head_17k.off",
                                         "open/pmp_hemisphere_3k6.off", "dirty/gc_moebius.obj",
                                         "dirty/cgal_blobby_shuffled_winding.off", "dirty/mlab_office_chair.obj",
                                         "dirty/mlab_conrod_badwinding.stl", "dirty/trimesh_soup.stl",
                                         "dirty/assimp_spider.obj", "animated/Fox.glb"));

class ContourOfClosedMesh : public testing::TestWithParam<const char*> {};

TEST_P(ContourOfClosedMesh, FormsClosedLoops) {
  RINKAKU_NEEDS_DATA();
  const Mesh mesh = import(test::data(std::string("meshes/") + GetParam())).mesh;
  const Topology t = topology(mesh);
  ContourFinder finder(mesh, t);
  for (const glm::dvec4& eye : eyes_around(mesh, 60)) {
    std::vector<int> degree(t.points.size(), 0);
    for (const std::uint32_t e : finder.find(eye).edges) {
      ++degree[t.edges[e].a];
      ++degree[t.edges[e].b];
    }
    ASSERT_TRUE(std::all_of(degree.begin(), degree.end(), [](int d) { return d % 2 == 0; }))
        << eye.x << ' ' << eye.y << ' ' << eye.z << ' ' << eye.w;
  }
}
INSTANTIATE_TEST_SUITE_P(Meshes, ContourOfClosedMesh,
                         testing::Values("closed/oded_spot_23k.obj", "closed/cgal_cheese_genus133.off",
                                         "closed/pmp_fandisk_13k.off", "closed/oded_human_man_14k.obj",
                                         "dirty/cgal_blobby_shuffled_winding.off", "dirty/cgal_boeing_soup.off"));

TEST(ContourFinder, TrianglesThatFaceTheEyeAreListed) {
  const Mesh mesh = assemble(sphere(4), 60).mesh;
  const Topology t = topology(mesh);
  ContourFinder finder(mesh, t, {.margin = 1e-3});
  const glm::dvec3 eye(3, 1, 2);
  const Contour& found = finder.find(eye);
  std::size_t front = 0;
  for (std::size_t f = 0; f < t.faces.size(); ++f) front += found.front[f];
  EXPECT_GE(found.front_indices.size(), front * 3);
  EXPECT_LT(found.front_indices.size(), front * 3 * 1.04) << "few doubtful";
  ASSERT_EQ(found.front_parts.size(), 1u);
  EXPECT_EQ(found.front_parts[0].count, found.front_indices.size());
}

TEST(ContourFinder, DoubtfulTrianglesAreListed) {
  const Mesh mesh = assemble(sphere(3), 60).mesh;
  const Topology t = topology(mesh);
  ContourFinder finder(mesh, t, {.margin = 1.0});
  const Contour& found = finder.find(glm::dvec3(0, 0, 5));
  EXPECT_EQ(found.front_indices.size(), mesh.triangles.size() * 3);
  const std::size_t contour = found.edges.size();
  ContourFinder strict(mesh, t, {.margin = 0.0});
  EXPECT_EQ(strict.find(glm::dvec3(0, 0, 5)).edges.size(), contour) << "the margin does not move the contour";
}

TEST(ContourFinder, OpenSurfacesAndTwoSidedMaterialsAreDrawnFromBehindToo) {
  const Mesh open = assemble(square(), 60).mesh;
  ContourFinder of_open(open, topology(open));
  EXPECT_EQ(of_open.find(glm::dvec3(0.5, 0.5, 3)).front_indices.size(), 6u);
  const Contour& behind = of_open.find(glm::dvec3(0.5, 0.5, -3));
  EXPECT_EQ(behind.front_indices.size(), 6u);
  EXPECT_EQ(behind.edges.size(), 4u);

  Mesh closed = assemble(sphere(2), 60).mesh;
  const Topology t = topology(closed);
  EXPECT_LT(ContourFinder(closed, t).find(glm::dvec3(0, 0, 3)).front_indices.size(), closed.triangles.size() * 3);
  closed.materials[0].two_sided = true;
  EXPECT_EQ(ContourFinder(closed, t).find(glm::dvec3(0, 0, 3)).front_indices.size(), closed.triangles.size() * 3);
}

TEST(ContourFinder, FrontPartsSplitTheListByMaterial) {
  Soup soup = sphere(3);
  soup.parts = {{"a", 0, 100, 0}, {"b", 100, static_cast<std::uint32_t>(soup.triangles.size()) - 100, 1}};
  soup.materials.resize(2);
  const Mesh mesh = assemble(std::move(soup), 60).mesh;
  ContourFinder finder(mesh, topology(mesh));
  const Contour& found = finder.find(glm::dvec3(2, 3, 4));
  ASSERT_EQ(found.front_parts.size(), 2u);
  EXPECT_EQ(found.front_parts[0].first, 0u);
  EXPECT_EQ(found.front_parts[1].first, found.front_parts[0].count);
  EXPECT_EQ(found.front_parts[0].count + found.front_parts[1].count, found.front_indices.size());
  std::set<std::array<std::uint32_t, 3>> of_first;
  for (std::uint32_t f = 0; f < 100; ++f)
    of_first.insert({mesh.triangles[f].x, mesh.triangles[f].y, mesh.triangles[f].z});
  for (std::uint32_t i = 0; i < found.front_indices.size(); i += 3) {
    const auto* v = &found.front_indices[i];
    EXPECT_EQ(of_first.count({v[0], v[1], v[2]}), i < found.front_parts[0].count ? 1u : 0u);
  }
}

TEST(ContourFinder, HomogeneousEyesMayBeScaledAndNegative) {
  const Mesh mesh = assemble(sphere(4), 60).mesh;
  ContourFinder finder(mesh, topology(mesh));
  const auto edges_at = [&](const glm::dvec4& eye) {
    const auto edges = finder.find(eye).edges;
    return std::vector<std::uint32_t>(edges.begin(), edges.end());
  };
  const auto plain = edges_at({3, 4, 5, 1});
  EXPECT_EQ(edges_at({6, 8, 10, 2}), plain);
  EXPECT_EQ(edges_at({-3, -4, -5, -1}), plain);
}

}  // namespace
}  // namespace rinkaku::mesh
