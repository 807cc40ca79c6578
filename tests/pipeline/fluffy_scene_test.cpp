#include <gtest/gtest.h>

#include "tests/pipeline/scene_folder.h"

namespace rinkaku::pipeline {
namespace {

using namespace test_scenes;

FluffyScene read(const std::string& keys) {
  const SceneFolder folder;
  std::ofstream(folder / "fur.png");
  return *folder.read(object + keys + "\n").objects[0].fluffy;
}

std::string message(const std::string& keys) {
  const SceneFolder folder;
  std::ofstream(folder / "fur.png");
  return folder.message(object + keys + "\n");
}

TEST(FluffyScene, IsOffUnlessAskedFor) {
  const SceneFolder folder;
  EXPECT_FALSE(folder.read(object).objects[0].fluffy);
  EXPECT_FALSE(folder.read(object + "fluffy = false\n").objects[0].fluffy);
}

TEST(FluffyScene, FillsInDefaults) {
  const FluffyScene fluff = read("fluffy = true");
  EXPECT_EQ(fluff.made_texture, fluffy::FurKind::Fur);
  EXPECT_EQ(fluff.frame.scale, 1.1);
  EXPECT_EQ(fluff.frame.growth, fluffy::Growth::AlongNormals);
  EXPECT_FALSE(fluff.mesh_coordinates_if_any);
  EXPECT_EQ(fluff.angle_deg, 70);
  EXPECT_EQ(fluff.paint, FluffyScene::Paint::Body);
  EXPECT_EQ(fluff.line, FluffyScene::Line::Rim);
  EXPECT_EQ(fluff.cut, FluffyScene::Cut::Exact);
}

TEST(FluffyScene, ReadsEveryKey) {
  const FluffyScene fluff = read(
      "outline = true\n"
      "fluffy = { texture = \"wool\", threshold = 0.25, keep = \"below\", parts = [\"mane\", \"tail*\"], "
      "vertex_paint = \"blue\", length_m = 0.02, exaggeration = 1.5, tile_m = 0.3, angle_deg = 45, layers = 5, "
      "colour = \"#0000ff\", hang = 0, line = \"body\", cut = \"regions\" }");
  EXPECT_EQ(fluff.made_texture, fluffy::FurKind::Wool);
  EXPECT_EQ(fluff.threshold, 0.25);
  EXPECT_EQ(fluff.keep, FluffyScene::Keep::Below);
  EXPECT_EQ(fluff.frame.selection.names, (std::vector<std::string>{"mane", "tail*"}));
  EXPECT_EQ(fluff.frame.selection.painted_channel, 2);
  EXPECT_EQ(fluff.frame.length_m, 0.02);
  EXPECT_EQ(fluff.frame.exaggeration, 1.5);
  EXPECT_EQ(fluff.frame.tile_m, 0.3);
  EXPECT_EQ(fluff.angle_deg, 45);
  EXPECT_EQ(fluff.layers, 5);
  EXPECT_EQ(fluff.paint, FluffyScene::Paint::Own);
  EXPECT_EQ(fluff.colour, (std::array{0.0, 0.0, 1.0}));
  EXPECT_EQ(fluff.hang, 0);
  EXPECT_EQ(fluff.line, FluffyScene::Line::Body);
  EXPECT_EQ(fluff.cut, FluffyScene::Cut::Regions);
}

TEST(FluffyScene, APictureIsLaidOnAsTheMeshHasItAndInItsOwnColours) {
  const FluffyScene fluff = read("fluffy = { texture = \"fur.png\", mode = \"scaled\", scale = 1.3, repeat = 2 }");
  EXPECT_FALSE(fluff.made_texture);
  EXPECT_EQ(fluff.texture.filename(), "fur.png");
  EXPECT_TRUE(fluff.mesh_coordinates_if_any);
  EXPECT_EQ(fluff.paint, FluffyScene::Paint::Texture);
  EXPECT_EQ(fluff.frame.growth, fluffy::Growth::Scaled);
  EXPECT_EQ(fluff.frame.scale, 1.3);
  EXPECT_EQ(fluff.frame.repeat, 2);
  EXPECT_EQ(read("fluffy = { texture = \"fur.png\", colour = \"body\" }").paint, FluffyScene::Paint::Body);
  EXPECT_EQ(read("fluffy = { parts = \"mane\" }").frame.selection.names, std::vector<std::string>{"mane"});
}

TEST(FluffyScene, BadOnesAreRefusedInOneLine) {
  const std::string in = "DIR/scene.toml:8:";
  EXPECT_EQ(message("fluffy = { lenght_m = 1 }"),
            in + "12: unknown key 'lenght_m' in fluffy of [[object]]; did you mean 'length_m'?");
  EXPECT_EQ(message("fluffy = { scale = 1 }").substr(0, 60),
            (in + "20: 'scale' in fluffy of [[object]] must be a number above 1").substr(0, 60));
  EXPECT_NE(message("fluffy = { texture = \"furr\" }").find("'texture' in fluffy"), std::string::npos);
  EXPECT_EQ(message("fluffy = { mode = \"scaled\", length_m = 0.1 }"),
            in + "40: 'length_m' in fluffy of [[object]] goes with mode = \"normals\"; give 'scale' instead");
  EXPECT_EQ(message("fluffy = { repeat = 2 }"),
            in + "21: 'repeat' in fluffy of [[object]] goes with coordinates = \"mesh\"; add that, or give 'tile_m'");
  EXPECT_EQ(message("fluffy = { coordinates = \"mesh\", tile_m = 2 }"),
            in + "43: 'tile_m' in fluffy of [[object]] goes with coordinates = \"generated\"; add that, or give "
                 "'repeat'");
  EXPECT_EQ(message("fluffy = { line = \"rim\" }"),
            in + "19: 'line' in fluffy of [[object]] says where the outline runs, and the object has none; add "
                 "'outline' to it");
  EXPECT_EQ(message("fluffy = { parts = [] }"),
            in + "20: 'parts' in fluffy of [[object]] names nothing; leave it out for the whole mesh");
  EXPECT_NE(message("fluffy = { parts = [3] }").find("must be a name or an array of names"), std::string::npos);
  EXPECT_NE(message("fluffy = { layers = 0 }").find("'layers'"), std::string::npos);
  EXPECT_NE(message("holdout = true\nfluffy = true").find("'fluffy' in [[object]] has no meaning for a holdout"),
            std::string::npos);
}

}  // namespace
}  // namespace rinkaku::pipeline
