#include "mesh/pose.h"

#include "tests/mesh/rigs.h"

namespace rinkaku::mesh {
namespace {

constexpr double half_root = 0.70710678118654752;

TEST(AnimationTime, LoopsStopsAndRunsBackwards) {
  const double duration_s = 2;
  const Playback loop{0, true, 0, 1};
  EXPECT_DOUBLE_EQ(animation_time_s(loop, duration_s, 0.5), 0.5);
  EXPECT_DOUBLE_EQ(animation_time_s(loop, duration_s, 4.5), 0.5);
  EXPECT_DOUBLE_EQ(animation_time_s(loop, duration_s, -0.5), 1.5);
  const Playback once{0, false, 1, 2};
  EXPECT_DOUBLE_EQ(animation_time_s(once, duration_s, 0), 0);
  EXPECT_DOUBLE_EQ(animation_time_s(once, duration_s, 1.5), 1);
  EXPECT_DOUBLE_EQ(animation_time_s(once, duration_s, 5), 2);
  const Playback backwards{0, false, 0, -1};
  EXPECT_DOUBLE_EQ(animation_time_s(backwards, duration_s, 0.5), 1.5);
  EXPECT_DOUBLE_EQ(animation_time_s(backwards, duration_s, 3), 0);
  EXPECT_DOUBLE_EQ(animation_time_s(loop, 0, 3), 0) << "a clip of a single moment";
}

Rig one_node() {
  Rig rig;
  rig.nodes.push_back({"n", RigNode::kNoParent, glm::mat4(1)});
  rig.joints.push_back({0, glm::mat4(1)});
  return rig;
}

TEST(Poser, InterpolatesKeysAndHoldsTheirEnds) {
  const Rig rig = one_node();
  Animation moves{"moves", 3, {}, {}};
  moves.tracks.push_back({0,
                          {{1, 2}, {{0, 0, 0}, {10, 0, 0}}},
                          {{1, 2}, {glm::quat(1, 0, 0, 0), glm::quat(half_root, 0, 0, half_root)}},
                          {{1, 2}, {glm::vec3(1), glm::vec3(3)}}});
  Poser poser(rig);
  const auto at = [&](double time_s, const glm::vec3& p) {
    return glm::vec3(poser.at(moves, time_s).joints[0] * glm::vec4(p, 1));
  };
  EXPECT_LT(glm::distance(at(0, {1, 0, 0}), glm::vec3(1, 0, 0)), 1e-6f);
  EXPECT_LT(glm::distance(at(9, {1, 0, 0}), glm::vec3(10, 3, 0)), 1e-5f);
  // Half-way: scaled by 2, turned by 45 degrees about z, moved by 5.
  EXPECT_LT(glm::distance(at(1.5, {1, 0, 0}), glm::vec3(5 + 2 * half_root, 2 * half_root, 0)), 1e-5f);
}

TEST(Poser, RotationsTakeTheShorterArc) {
  const Rig rig = one_node();
  Animation turns{"turns", 1, {}, {}};
  // The second key is the quaternion's other sign: the same rotation by 90 degrees.
  turns.tracks.push_back({0,
                          test::key(glm::vec3(0)),
                          {{0, 1}, {glm::quat(1, 0, 0, 0), glm::quat(-half_root, 0, 0, -half_root)}},
                          test::key(glm::vec3(1))});
  Poser poser(rig);
  const glm::vec4 p = poser.at(turns, 0.5).joints[0] * glm::vec4(1, 0, 0, 1);
  EXPECT_NEAR(p.x, half_root, 1e-6);
  EXPECT_NEAR(p.y, half_root, 1e-6);
}

TEST(Poser, ChildrenGoWithTheirParents) {
  Rig rig = one_node();
  rig.nodes.push_back({"child", 0, glm::translate(glm::mat4(1), glm::vec3(2, 0, 0))});
  rig.joints.push_back({1, glm::mat4(1)});
  Poser poser(rig);
  EXPECT_EQ(glm::vec3(poser.rest().joints[1][3]), glm::vec3(2, 0, 0));
  const Animation turned = test::still(0, {0, 0, 1}, glm::quat(half_root, 0, 0, half_root), glm::vec3(1));
  EXPECT_LT(glm::distance(glm::vec3(poser.at(turned, 0).joints[1][3]), glm::vec3(0, 2, 1)), 1e-6f);
}

TEST(Poser, MorphsWithoutTrackKeepTheirRestWeight) {
  Rig rig = one_node();
  rig.morphs = {{"a", 0.25f, {}, {}}, {"b", 0.5f, {}, {}}, {"c", 0.75f, {}, {}}};
  Animation grows{"grows", 1, {}, {}};
  grows.morph_tracks.push_back({1, 2, {0, 1}, {0, 1, 1, 0}});
  Poser poser(rig);
  const std::vector<float> quarter = poser.at(grows, 0.25).morph_weights;
  EXPECT_EQ(quarter, (std::vector<float>{0.25f, 0.25f, 0.75f}));
}

TEST(Poser, KeysAtOneTimeAreAJump) {
  const Rig rig = one_node();
  Animation steps{"steps", 2, {}, {}};
  steps.tracks.push_back({0,
                          {{0, 1, 1, 2}, {{0, 0, 0}, {0, 0, 0}, {5, 0, 0}, {5, 0, 0}}},
                          test::key(glm::quat(1, 0, 0, 0)),
                          test::key(glm::vec3(1))});
  Poser poser(rig);
  EXPECT_EQ(poser.at(steps, 0.999).joints[0][3].x, 0);
  EXPECT_EQ(poser.at(steps, 1).joints[0][3].x, 5);
}

}  // namespace
}  // namespace rinkaku::mesh
