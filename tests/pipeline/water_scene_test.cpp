// [water] in scene files: what is taken, and what is refused in which words.
#include "tests/pipeline/scene_folder.h"

namespace rinkaku::pipeline {
namespace {

using namespace test_scenes;

const std::string water = tracked + "[water]\n";  // line 6
const std::string surface =
    water + "[[water.surface]]\noutline_m = [[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]]\n";  // lines 7 and 8
const std::string arrow = surface + "[[water.surface.arrow]]\n";                              // line 9

TEST(WaterScene, HasDefaults) {
  const WaterScene w = *SceneFolder().read(surface).water;
  EXPECT_EQ(w.strokes, 7000);
  EXPECT_EQ(w.flow, WaterScene::Flow::DivergenceFree);
  EXPECT_EQ(w.colours, WaterScene::Colours::ByCamera);
  EXPECT_TRUE(w.waterline);
  ASSERT_EQ(w.surfaces.size(), 1u);
  EXPECT_EQ(w.surfaces[0].outline_m[2], glm::dvec3(2, 1, 0));
  EXPECT_TRUE(w.surfaces[0].open.empty());
}

TEST(WaterScene, IsReadWhole) {
  const SceneFolder folder;
  std::ofstream(folder / "brush.png");
  const WaterScene w = *folder
                            .read(water +
                                  "strokes = 300\ncolour = \"#204060\"\nstroke = { length_m = 0.2, width_px = 5 }\n"
                                  "flow = { method = \"arrows\", alpha_m = 0.5 }\n"
                                  "mirror = { plate = false, zenith = [0, 0, 1] }\n"
                                  "colours = { method = \"followed\" }\nwaterline = false\n"
                                  "[[water.surface]]\noutline_m = [[0, 0, 0], [2, 0, 0], [2, 1, 0]]\nopen = [2]\n"
                                  "obstacles_m = [[[1, 0.1, 0], [1.2, 0.1, 0], [1.2, 0.3, 0]]]\n"
                                  "[[water.surface.arrow]]\nframe = 40\nfrom_px = [3, 4]\nto_px = [5, 6]\n"
                                  "[[water.surface.arrow]]\nfrom_m = [0, 0, 0]\nto_m = [1, 0, 0]\n"
                                  "[[water.spray]]\nfrom_m = [0, 0, 0]\nto_m = [1, 0, 0]\ndrops = 9\n"
                                  "[[water.brush]]\nimage = \"brush.png\"\nat_px = [1, 2]\n")
                            .water;
  EXPECT_EQ(w.strokes, 300);
  EXPECT_EQ(w.length_m, 0.2);
  EXPECT_EQ(w.width_px, 5.0);
  EXPECT_EQ(w.flow, WaterScene::Flow::Arrows);
  EXPECT_FALSE(w.mirror_plate);
  EXPECT_FALSE(w.waterline);
  EXPECT_EQ(w.surfaces[0].open, std::vector<int>{2});
  EXPECT_EQ(w.surfaces[0].obstacles_m.size(), 1u);
  ASSERT_EQ(w.surfaces[0].arrows.size(), 2u);
  EXPECT_EQ(w.surfaces[0].arrows[0].frame, 0);  // in order of frames
  EXPECT_EQ(w.surfaces[0].arrows[1].to_px, glm::dvec2(5, 6));
  EXPECT_EQ(w.sprays[0].drops, 9);
  EXPECT_EQ(w.brushes[0].at_px, glm::dvec2(1, 2));
}

struct BadWater {
  std::string name, text, message;
};
class BadWaterTest : public testing::TestWithParam<BadWater> {};
TEST_P(BadWaterTest, IsRefusedInOneLine) { EXPECT_EQ(SceneFolder().message(GetParam().text), GetParam().message); }

INSTANTIATE_TEST_SUITE_P(
    Scenes, BadWaterTest,
    testing::Values(
        BadWater{
            "NoPose", plate + "[water]\n",
            "DIR/scene.toml:4:1: [water] needs a camera pose; add [track] with one of marker, board, poses, locked"},
        BadWater{"NoSurface", water, "DIR/scene.toml:6:1: [water] needs one of 'surface'"},
        BadWater{"Misspelt", water + "stroks = 3\n",
                 "DIR/scene.toml:7:1: unknown key 'stroks' in [water]; did you mean 'strokes'?"},
        BadWater{"TwoCorners", water + "[[water.surface]]\noutline_m = [[0, 0, 0], [1, 0, 0]]\n",
                 "DIR/scene.toml:8:13: 'outline_m' in surface of [water] must be three corners [x, y, z] or more, in "
                 "metres, found an array of 2"},
        BadWater{
            "NoSuchEdge", surface + "open = [4]\n",
            "DIR/scene.toml:9:8: 'open' in surface of [water] must be numbers of edges from 0 to 3, found an array "
            "of 1"},
        BadWater{"ArrowWithoutEnd", arrow + "from_px = [1, 2]\n",
                 "DIR/scene.toml:9:1: 'to_px' in arrow of surface of [water] is missing"},
        BadWater{"ArrowTwice", arrow + "from_px = [1, 2]\nfrom_m = [0, 0, 0]\n",
                 "DIR/scene.toml:11:10: 'from_m' in arrow of surface of [water] can't stand beside 'from_px'; keep one "
                 "of them"},
        BadWater{
            "UnevenKeys",
            arrow + "from_m = [0, 0, 0]\nto_m = [1, 0, 0]\n[[water.surface.arrow]]\nframe = 5\n"
                    "from_m = [0, 0, 0]\nto_m = [1, 0, 0]\n[[water.surface.arrow]]\nframe = 5\n"
                    "from_m = [0, 0, 0]\nto_m = [1, 0, 0]\n",
            "DIR/scene.toml:9:1: 'arrow' in surface of [water] has 2 for frame 5 but 1 for frame 0; give every key "
            "frame as many arrows, in the same order"},
        BadWater{"ManyStrokes", water + "strokes = 2000000\n[[water.surface]]\n",
                 "DIR/scene.toml:7:11: 'strokes' in [water] must be a whole number from 1 to 1000000, found 2000000"},
        BadWater{
            "KeysFarApart", water + "colours = { key_frames = 121 }\n[[water.surface]]\n",
            "DIR/scene.toml:7:26: 'key_frames' in colours of [water] must be a whole number from 1 to 120, found 121"}),
    [](const testing::TestParamInfo<BadWater>& bad) { return bad.param.name; });

}  // namespace
}  // namespace rinkaku::pipeline
