#include "mesh/skin.h"

#include <random>

#include "mesh/moving_mesh.h"
#include "tests/mesh/rigs.h"

namespace rinkaku::mesh {
namespace {

using test::Rigged;

Skin skin_of(const Rigged& rigged) { return Skin(rigged.mesh, topology(rigged.mesh), rigged.rig); }

void pose_as(Skin& skin, const Rig& rig, const Animation& animation, double time_s = 0) {
  Poser poser(rig);
  skin.pose(poser.at(animation, time_s));
}

void expect_sound(const Skin& skin) {
  for (const glm::vec3& p : skin.points()) ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
  for (const auto& normals : {skin.normals(), skin.outline_normals()}) {
    for (const glm::vec3& n : normals) ASSERT_NEAR(glm::length(n), 1, 1e-5);
  }
}

// Float sums of a few terms of size 1 to 3.
constexpr float rounding = 2e-6f;

TEST(Skin, AtRestGivesTheMeshBack) {
  const Rigged cylinder = test::bending_cylinder(24, 20);
  Skin skin = skin_of(cylinder);
  const Topology topology = mesh::topology(cylinder.mesh);
  pose_as(skin, cylinder.rig, cylinder.rig.animations[0], 0);
  for (std::size_t p = 0; p < topology.points.size(); ++p) {
    EXPECT_LT(glm::distance(skin.points()[p], topology.points[p]), rounding);
    EXPECT_LT(glm::distance(skin.outline_normals()[p], topology.outline_normals[p]), rounding);
  }
  for (std::size_t v = 0; v < cylinder.mesh.normals.size(); ++v) {
    EXPECT_LT(glm::distance(skin.normals()[v], cylinder.mesh.normals[v]), rounding);
  }
}

TEST(Skin, BendsByTheWeightsOfItsBones) {
  const Rigged cylinder = test::bending_cylinder(24, 20);
  Skin skin = skin_of(cylinder);
  pose_as(skin, cylinder.rig, cylinder.rig.animations[0], 0.5);
  const Topology rest = topology(cylinder.mesh);
  const double s = std::sin(std::numbers::pi / 4), c = std::cos(std::numbers::pi / 4);
  for (std::size_t p = 0; p < rest.points.size(); ++p) {
    const glm::dvec3 at(rest.points[p]);
    // Turned by 45 degrees about z around (0, 1, 0).
    const glm::dvec3 turned(c * at.x - s * (at.y - 1), s * at.x + c * (at.y - 1) + 1, at.z);
    const double upper = test::bend_weight(rest.points[p].y);
    EXPECT_LT(glm::distance(glm::dvec3(skin.points()[p]), at * (1 - upper) + turned * upper), rounding);
  }
}

TEST(Skin, NormalsStayAtRightAnglesUnderUnevenScale) {
  const glm::vec3 scale(1, 2, 0.5);
  const Rigged ball = test::on_one_node(test::sphere(4));
  Skin skin = skin_of(ball);
  pose_as(skin, ball.rig, test::still(0, {5, 0, 0}, glm::quat(1, 0, 0, 0), scale));
  for (std::size_t p = 0; p < skin.points().size(); ++p) {
    const glm::vec3 on_ball = (skin.points()[p] - glm::vec3(5, 0, 0)) / scale;
    // The ellipsoid's gradient. The ball's own outline normals miss the radius by a triangle's share (1/16 of its
    // angle, here 0.02), and the scale stretches that up to four times.
    EXPECT_GT(glm::dot(skin.outline_normals()[p], glm::normalize(on_ball / scale)), std::cos(0.08));
  }
}

TEST(Skin, MirroringKeepsNormalsOutside) {
  for (const glm::vec3 scale : {glm::vec3(-1, 1, 1), glm::vec3(-1, -1, -1)}) {
    const Rigged ball = test::on_one_node(test::sphere(2), glm::scale(glm::mat4(1), scale));
    Skin skin = skin_of(ball);
    for (std::size_t p = 0; p < skin.points().size(); ++p) {
      // Triangles of a soup whose node mirrors are listed the other way round by the reader; here they are not, so that
      // the mesh at rest is inside out, and has to stay what it is.
      EXPECT_LT(glm::dot(skin.outline_normals()[p], skin.points()[p]), -0.9f);
    }
  }
}

TEST(Skin, SqueezedAndTwistedMeshesStayFinite) {
  const Rigged cylinder = test::bending_cylinder(16, 20);
  Skin skin = skin_of(cylinder);
  for (const double time_s : {0.5, 0.97, 1.0}) {
    pose_as(skin, cylinder.rig, cylinder.rig.animations[1], time_s);
    expect_sound(skin);
  }
  // Half-way up, a twist by 180 degrees puts all points on the axis.
  const auto middle = std::find_if(cylinder.rig.bind_points.begin(), cylinder.rig.bind_points.end(),
                                   [](const glm::vec3& p) { return p.y == 1; });
  const glm::vec3 squeezed = skin.points()[static_cast<std::size_t>(middle - cylinder.rig.bind_points.begin())];
  EXPECT_LT(std::hypot(squeezed.x, squeezed.z), 1e-6);
  for (const glm::vec3 scale : {glm::vec3(0), glm::vec3(0, 1, 1), glm::vec3(1e-20f, 1, 0), glm::vec3(1e12f)}) {
    pose_as(skin, cylinder.rig, test::still(1, {0, 1, 0}, glm::quat(1, 0, 0, 0), scale));
    expect_sound(skin);
    pose_as(skin, cylinder.rig, test::still(0, {0, 0, 0}, glm::quat(1, 0, 0, 0), scale));
    expect_sound(skin);
  }
}

TEST(Skin, RestPoseOfScaleZeroUnfolds) {
  const glm::mat4 nothing = glm::scale(glm::mat4(1), glm::vec3(0));
  const Rigged ball = test::on_one_node(test::sphere(2), nothing);
  // Its vertices are at one place, but are no one point.
  ASSERT_EQ(ball.mesh.triangles.size(), test::sphere(2).triangles.size());
  Skin skin = skin_of(ball);
  pose_as(skin, ball.rig, test::still(0, {0, 0, 0}, glm::quat(1, 0, 0, 0), glm::vec3(2)));
  for (const glm::vec3& p : skin.points()) EXPECT_NEAR(glm::length(p), 2, 1e-5);
}

TEST(Skin, MorphsAddUpAndTurnNormals) {
  Soup soup = test::sphere(4);
  // From a ball to an ellipsoid of half axes 1, 1, 2, in two steps that add up.
  for (int half = 0; half < 2; ++half) {
    Morph& morph = soup.rig.morphs.emplace_back();
    for (std::uint32_t v = 0; v < soup.positions.size(); ++v) {
      morph.points.push_back(v);
      morph.offsets.emplace_back(0, 0, soup.positions[v].z / 2);
    }
  }
  const Rigged ball = test::on_one_node(std::move(soup));
  Skin skin = skin_of(ball);
  Animation grown = test::still(0, {0, 0, 0}, glm::quat(1, 0, 0, 0), glm::vec3(1));
  grown.morph_tracks.push_back({0, 2, {0.0f}, {1.0f, 1.0f}});
  pose_as(skin, ball.rig, grown);
  const Topology rest = topology(ball.mesh);
  for (std::size_t p = 0; p < rest.points.size(); ++p) {
    const glm::vec3 from = rest.points[p];
    EXPECT_LT(glm::distance(skin.points()[p], glm::vec3(from.x, from.y, 2 * from.z)), rounding);
    const glm::vec3 truth = glm::normalize(glm::vec3(from.x, from.y, from.z / 2));
    // Two halves of a bend add up to less than the whole one: at 45 degrees the normal turns by 18, of which 1.5 miss;
    // and the faces' mean is off by a share of their angle.
    EXPECT_GT(glm::dot(skin.outline_normals()[p], truth), std::cos(glm::radians(5.0f)));
  }
  // And back again.
  pose_as(skin, ball.rig, test::still(0, {0, 0, 0}, glm::quat(1, 0, 0, 0), glm::vec3(1)));
  for (std::size_t p = 0; p < rest.points.size(); ++p) {
    EXPECT_LT(glm::distance(skin.points()[p], rest.points[p]), rounding);
  }
}

TEST(Skin, TakesAnyNumberOfInfluences) {
  // Nine joints that all share the mesh: it goes where their mean is.
  Soup soup = test::cube();
  Rig& rig = soup.rig;
  rig.bind_points = soup.positions;
  rig.first_influence.push_back(0);
  for (std::uint32_t j = 0; j < 9; ++j) {
    rig.nodes.push_back({"n", RigNode::kNoParent, glm::mat4(1)});
    rig.joints.push_back({j, glm::mat4(1)});
  }
  for (std::size_t v = 0; v < soup.positions.size(); ++v) {
    for (std::uint32_t j = 0; j < 9; ++j) rig.influences.push_back({j, 1.0f / 9});
    rig.first_influence.push_back(static_cast<std::uint32_t>(rig.influences.size()));
  }
  const Rigged cube = test::assembled(std::move(soup));
  Skin skin = skin_of(cube);
  Animation apart{"apart", 1, {}, {}};
  for (std::uint32_t j = 0; j < 9; ++j) {
    apart.tracks.push_back({j, test::key(glm::vec3(0, 0, static_cast<float>(j))), test::key(glm::quat(1, 0, 0, 0)),
                            test::key(glm::vec3(1))});
  }
  pose_as(skin, cube.rig, apart);
  const Topology rest = topology(cube.mesh);
  for (std::size_t p = 0; p < rest.points.size(); ++p) {
    EXPECT_LT(glm::distance(skin.points()[p], rest.points[p] + glm::vec3(0, 0, 4)), rounding);
  }
}

TEST(BindRig, LipsThatPartAreNotWelded) {
  // Two squares that share an edge; the second one's vertices there are vertices of its own.
  Soup soup;
  soup.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}};
  soup.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  soup = test::one_part(std::move(soup));
  Rig& rig = soup.rig;
  rig.nodes = {{"a", RigNode::kNoParent, glm::mat4(1)}, {"b", RigNode::kNoParent, glm::mat4(1)}};
  rig.joints = {{0, glm::mat4(1)}, {1, glm::mat4(1)}};
  rig.bind_points = soup.positions;
  rig.first_influence = {0, 1, 2, 3, 4, 5, 6, 7, 8};
  const auto carried = [&](const std::vector<std::uint32_t>& joints) {
    Soup copy = soup;
    for (const std::uint32_t j : joints) copy.rig.influences.push_back({j, 1.0f});
    return test::assembled(std::move(copy));
  };
  EXPECT_EQ(carried({0, 0, 0, 0, 0, 0, 0, 0}).mesh.point_count, 6u);
  EXPECT_EQ(carried({0, 0, 0, 0, 1, 1, 1, 1}).mesh.point_count, 8u);
  EXPECT_EQ(carried({0, 0, 0, 0, 0, 1, 1, 1}).mesh.point_count, 7u);
}

TEST(BindRig, MorphThatOpensASeamPartsIt) {
  Soup soup;
  soup.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 0}, {0, -1, 0}};
  soup.triangles = {{0, 1, 2}, {3, 4, 5}};
  soup.rig.morphs.push_back({"open", 0, {3, 4, 5}, {{0, -1, 0}, {0, -1, 0}, {0, -1, 0}}});
  EXPECT_EQ(test::on_one_node(test::one_part(soup)).mesh.point_count, 6u);
  soup.rig.morphs.clear();
  EXPECT_EQ(test::on_one_node(test::one_part(soup)).mesh.point_count, 4u);
}

TEST(MovingMesh, SameTimeGivesTheSamePoseWhateverWasBefore) {
  const Rigged cylinder = test::bending_cylinder(12, 10);
  const Topology rest = topology(cylinder.mesh);
  MovingMesh straight(cylinder.mesh, rest, cylinder.rig, {}), jumping(cylinder.mesh, rest, cylinder.rig, {});
  for (const double t : {0.7, 123.4, -3.0, 0.1}) jumping.move_to(t);
  EXPECT_TRUE(straight.move_to(0.35));
  EXPECT_FALSE(straight.move_to(0.35));
  EXPECT_TRUE(jumping.move_to(0.35));
  EXPECT_TRUE(std::equal(straight.skin().points().begin(), straight.skin().points().end(),
                         jumping.skin().points().begin(), jumping.skin().points().end()));
}

}  // namespace
}  // namespace rinkaku::mesh
