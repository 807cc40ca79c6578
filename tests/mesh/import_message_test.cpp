#include "mesh/import_message.h"

#include <random>

#include "tests/mesh/rigs.h"

namespace rinkaku::mesh {
namespace {

Imported sample() {
  Imported imported;
  Soup soup = test::sphere(2);
  soup.uvs.assign(soup.positions.size(), {0.25f, 0.75f});
  soup.materials[0].name = "paint";
  soup.materials[0].texture = 0;
  soup.textures.push_back({2, 1, {1, 2, 3, 4, 5, 6, 7, 8}});
  soup.rig.morphs.push_back({"smile", 0.5f, {1, 2}, {{1, 0, 0}, {0, 1, 0}}});
  test::Rigged rigged = test::on_one_node(std::move(soup));
  imported.mesh = std::move(rigged.mesh);
  imported.rig = std::move(rigged.rig);
  imported.rig.animations.push_back(test::still(0, {1, 2, 3}, glm::quat(0, 1, 0, 0), glm::vec3(2)));
  imported.rig.animations[0].morph_tracks.push_back({0, 1, {0, 1}, {0.25f, 0.75f}});
  imported.summary.skin_names = {"body"};
  imported.summary.format = "OBJ";
  imported.summary.clips = {{"walk", 1.5}};
  imported.summary.warnings = {"texture a: not found"};
  imported.summary.dropped_lines = 3;
  return imported;
}

TEST(ImportMessage, ArrivesAsSent) {
  const Imported sent = sample();
  const auto message = decode(encode(sent));
  ASSERT_TRUE(message && message->imported);
  const Imported& got = *message->imported;
  EXPECT_EQ(got.mesh.positions, sent.mesh.positions);
  EXPECT_EQ(got.mesh.normals, sent.mesh.normals);
  EXPECT_EQ(got.mesh.uvs, sent.mesh.uvs);
  EXPECT_EQ(got.mesh.welded, sent.mesh.welded);
  EXPECT_EQ(got.mesh.triangles, sent.mesh.triangles);
  EXPECT_EQ(got.mesh.textures[0].rgba, sent.mesh.textures[0].rgba);
  EXPECT_EQ(got.mesh.materials[0].name, "paint");
  EXPECT_EQ(got.summary.format, "OBJ");
  EXPECT_EQ(got.summary.clips.at(0).name, "walk");
  EXPECT_EQ(got.summary.clips.at(0).duration_s, 1.5);
  EXPECT_EQ(got.summary.skin_names, sent.summary.skin_names);
  EXPECT_EQ(got.summary.warnings, sent.summary.warnings);
  EXPECT_EQ(got.summary.dropped_lines, 3u);
}

TEST(ImportMessage, RigArrivesAsSent) {
  const Rig sent = sample().rig;
  const auto message = decode(encode(sample()));
  ASSERT_TRUE(message && message->imported);
  const Rig& got = message->imported->rig;
  EXPECT_EQ(got.nodes.at(0).name, "root");
  EXPECT_EQ(got.bind_points, sent.bind_points);
  EXPECT_EQ(got.first_influence, sent.first_influence);
  ASSERT_EQ(got.influences.size(), sent.influences.size());
  EXPECT_EQ(got.influences.back().weight, 1.0f);
  EXPECT_EQ(got.morphs.at(0).name, "smile");
  EXPECT_EQ(got.morphs[0].rest_weight, 0.5f);
  EXPECT_EQ(got.morphs[0].points, sent.morphs[0].points);
  EXPECT_EQ(got.morphs[0].offsets, sent.morphs[0].offsets);
  const Animation& animation = got.animations.at(0);
  EXPECT_EQ(animation.name, "still");
  EXPECT_EQ(animation.tracks.at(0).position.values, (std::vector<glm::vec3>{{1, 2, 3}}));
  EXPECT_EQ(animation.tracks[0].rotation.values.at(0), glm::quat(0, 1, 0, 0));
  EXPECT_EQ(animation.tracks[0].scale.times_s, std::vector<float>{0});
  EXPECT_EQ(animation.morph_tracks.at(0).weights, (std::vector<float>{0.25f, 0.75f}));
}

TEST(ImportMessage, RigsAreChecked) {
  const auto refused = [](auto spoil) {
    Imported imported = sample();
    spoil(imported.rig);
    return !decode(encode(imported));
  };
  EXPECT_FALSE(refused([](Rig&) {}));
  EXPECT_FALSE(refused([](Rig& r) { r = {}; }));
  EXPECT_TRUE(refused([](Rig& r) { r.nodes[0].parent = 0; }));
  EXPECT_TRUE(refused([](Rig& r) { r.nodes[0].parent_from_node[1][2] = std::nanf(""); }));
  EXPECT_TRUE(refused([](Rig& r) { r.joints[0].node = 1; }));
  EXPECT_TRUE(refused([](Rig& r) { r.bind_points.pop_back(); }));
  EXPECT_TRUE(refused([](Rig& r) { r.bind_points[0].y = std::nanf(""); }));
  EXPECT_TRUE(refused([](Rig& r) { r.first_influence[1] = 0; }));
  EXPECT_TRUE(refused([](Rig& r) { r.first_influence.back() += 1; }));
  EXPECT_TRUE(refused([](Rig& r) { r.influences[3].joint = 1; }));
  EXPECT_TRUE(refused([](Rig& r) { r.influences[3].weight = std::nanf(""); }));
  EXPECT_TRUE(refused([](Rig& r) { r.morphs[0].points[0] = 1u << 20; }));
  EXPECT_TRUE(refused([](Rig& r) { r.morphs[0].offsets.pop_back(); }));
  EXPECT_TRUE(refused([](Rig& r) { r.animations[0].duration_s = -1; }));
  EXPECT_TRUE(refused([](Rig& r) { r.animations[0].tracks[0].node = 1; }));
  EXPECT_TRUE(refused([](Rig& r) { r.animations[0].tracks[0].position = {}; }));
  EXPECT_TRUE(refused([](Rig& r) { r.animations[0].tracks[0].scale.values.clear(); }));
  EXPECT_TRUE(refused([](Rig& r) { r.animations[0].morph_tracks[0].times_s = {1, 0}; }));
  EXPECT_TRUE(refused([](Rig& r) { r.animations[0].morph_tracks[0].count = 2; }));
  EXPECT_TRUE(refused([](Rig& r) { r.animations[0].morph_tracks[0].weights.pop_back(); }));
}

TEST(ImportMessage, FailureArrivesAsSent) {
  const auto message = decode(encode(ImportFailure{"what", "remedy"}));
  ASSERT_TRUE(message && message->failure);
  EXPECT_EQ(message->failure->what, "what");
  EXPECT_EQ(message->failure->remedy, "remedy");
}

TEST(ImportMessage, CutOffOrContinuedMessagesAreRefused) {
  std::vector<std::uint8_t> bytes = encode(sample());
  for (std::size_t length = 0; length < bytes.size(); length += 1 + length / 50) {
    EXPECT_FALSE(decode(std::span(bytes).first(length))) << length;
  }
  bytes.push_back(0);
  EXPECT_FALSE(decode(bytes));
}

TEST(ImportMessage, IndicesAndLengthsAreChecked) {
  const auto refused = [](auto spoil) {
    Imported imported = sample();
    spoil(imported.mesh);
    return !decode(encode(imported));
  };
  EXPECT_FALSE(refused([](Mesh&) {}));
  EXPECT_TRUE(refused([](Mesh& m) { m.triangles[3].y = 1u << 30; }));
  EXPECT_TRUE(refused([](Mesh& m) { m.triangles[3].y = m.triangles[3].x; }));
  EXPECT_TRUE(refused([](Mesh& m) { m.welded[0] = m.point_count; }));
  EXPECT_TRUE(refused([](Mesh& m) { m.normals.pop_back(); }));
  EXPECT_TRUE(refused([](Mesh& m) { m.uvs.pop_back(); }));
  EXPECT_TRUE(refused([](Mesh& m) { m.positions[0].x = std::nanf(""); }));
  EXPECT_TRUE(refused([](Mesh& m) { m.parts[0].triangle_count -= 1; }));
  EXPECT_TRUE(refused([](Mesh& m) { m.parts[0].material = 1; }));
  EXPECT_TRUE(refused([](Mesh& m) { m.materials[0].texture = 1; }));
  EXPECT_TRUE(refused([](Mesh& m) { m.textures[0].width_px = 3; }));
  EXPECT_TRUE(refused([](Mesh& m) { m.textures[0].width_px = -2, m.textures[0].height_px = -1; }));
  EXPECT_TRUE(refused([](Mesh& m) { m.triangles.clear(), m.parts.clear(); }));
}

TEST(ImportMessage, RandomDamageNeverCrashes) {
  const std::vector<std::uint8_t> whole = encode(sample());
  std::mt19937 random(1);
  for (int round = 0; round < 20000; ++round) {
    std::vector<std::uint8_t> damaged = whole;
    for (int hit = 0; hit < 3; ++hit) damaged[random() % damaged.size()] = static_cast<std::uint8_t>(random());
    const auto message = decode(damaged);
    if (!message || !message->imported) continue;
    const Mesh& mesh = message->imported->mesh;
    for (const glm::uvec3& t : mesh.triangles) ASSERT_LT(std::max({t.x, t.y, t.z}), mesh.positions.size());
    for (const Influence& each : message->imported->rig.influences) {
      ASSERT_LT(each.joint, message->imported->rig.joints.size());
    }
  }
}

}  // namespace
}  // namespace rinkaku::mesh
