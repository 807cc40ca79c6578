#include <random>

#include "mesh/contour.h"
#include "mesh/moving_mesh.h"
#include "tests/mesh/rigs.h"

namespace rinkaku::mesh {
namespace {

using test::Rigged;

TEST(MovingContour, IsThatOfAMeshThatStandsSo) {
  const Rigged cylinder = test::bending_cylinder(40, 40);
  const Topology rest = topology(cylinder.mesh);
  ContourFinder moving(cylinder.mesh, rest);
  MovingMesh movement(cylinder.mesh, rest, cylinder.rig, {});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-6, 6);
  for (const double time_s : {0.1, 0.5, 0.95}) {
    movement.move_to(time_s);
    moving.move(rest.faces, movement.skin().points(), bounding_box(movement.skin().points()));
    const Mesh standing = test::posed(cylinder.mesh, movement.skin());
    const Topology fresh = topology(standing);
    ContourFinder still(standing, fresh);
    for (int i = 0; i < 50; ++i) {
      const glm::dvec3 eye(place(random), place(random), place(random));
      const Contour a = moving.find(eye), b = still.find(eye);
      for (std::size_t f = 0; f < rest.faces.size(); ++f) {
        if (a.front[f] == b.front[f]) continue;
        // Seen on edge: float planes differ by rounding, about 1e-6 of the size over a face of a fortieth of it.
        const glm::dvec3 corner(fresh.points[fresh.faces[f].x]);
        EXPECT_LT(std::abs(glm::dot(glm::normalize(eye - corner), glm::dvec3(fresh.face_normals[f]))), 1e-4);
      }
    }
  }
}

TEST(MovingContour, SqueezedPartsFaceLikeTheirNeighbours) {
  const Rigged cylinder = test::bending_cylinder(24, 20);
  const Topology rest = topology(cylinder.mesh);
  ContourFinder finder(cylinder.mesh, rest);
  Poser poser(cylinder.rig);
  Skin skin(cylinder.mesh, rest, cylinder.rig);
  // The upper half becomes one point, the cylinder a kind of cone.
  skin.pose(poser.at(test::still(1, {0, 1, 0}, glm::quat(1, 0, 0, 0), glm::vec3(0)), 0));
  finder.move(rest.faces, skin.points(), bounding_box(skin.points()));
  const Contour& contour = finder.find(glm::dvec3(10, 1, 0));
  // Closed loops still: every point has an even number of contour edges.
  std::vector<int> ends(rest.points.size(), 0);
  for (const std::uint32_t e : contour.edges) {
    ++ends[rest.edges[e].a];
    ++ends[rest.edges[e].b];
  }
  EXPECT_FALSE(contour.edges.empty());
  for (const int n : ends) EXPECT_EQ(n % 2, 0);
}

TEST(MovingContour, ComesBackFromHavingNoArea) {
  const Rigged ball = test::on_one_node(test::sphere(3));
  const Topology rest = topology(ball.mesh);
  ContourFinder finder(ball.mesh, rest), fresh(ball.mesh, rest);
  const std::vector<glm::vec3> at_one_place(rest.points.size(), glm::vec3(0));
  finder.move(rest.faces, at_one_place, Box{{0, 0, 0}, {0, 0, 0}});
  finder.find(glm::dvec3(0, 0, 5));
  finder.move(rest.faces, rest.points, bounding_box(rest.points));
  const Contour &a = finder.find(glm::dvec3(1, 2, 5)), &b = fresh.find(glm::dvec3(1, 2, 5));
  EXPECT_TRUE(std::equal(a.edges.begin(), a.edges.end(), b.edges.begin(), b.edges.end()));
}

}  // namespace
}  // namespace rinkaku::mesh
