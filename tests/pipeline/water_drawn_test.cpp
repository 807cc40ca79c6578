// Painted water, the whole way of a frame.
#include <algorithm>
#include <cstdlib>

#include "pipeline/gl/context.h"
#include "tests/pipeline/made_by.h"
#include "tests/pipeline/shot_folder.h"

namespace rinkaku::pipeline {
namespace {

using test::ShotFolder;

const PictureFormat small = test::picture("yuv420p", 64, 48, test::bt709_limited);

// A basin around the cube, which stands half under water.
const std::string basin =
    "[water]\nstrokes = 400\n[[water.surface]]\n"
    "outline_m = [[-1, -1, 0.2], [1, -1, 0.2], [1, 1, 0.2], [-1, 1, 0.2]]\n"
    "[[water.surface.arrow]]\nfrom_m = [0, -0.5, 0.2]\nto_m = [0.3, -0.5, 0.2]\n";
const std::string water_scene = test::plate + test::locked + basin;

std::size_t changed_samples(const Frame& a, const Frame& b) {
  const auto x = test::samples(a), y = test::samples(b);
  std::size_t n = 0;
  for (std::size_t i = 0; i < x.size(); ++i) n += x[i] != y[i];
  return n;
}

TEST(DrawnWater, CoversItsSurfaceAndLeavesTheRestAlone) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 4);
  folder.render(water_scene, {.output = "out.mkv", .codec = "ffv1"});
  const auto in = folder.frames("in.mkv"), out = folder.frames("out.mkv");
  ASSERT_EQ(out.size(), 4u);
  // Above the water's far edge nothing is touched: it lies at y = 1, z = 0.2 before a camera at (0.5, -2, 1), at
  // row 19.
  for (int y = 0; y < 17; ++y) {
    for (int x = 0; x < 64; ++x) ASSERT_EQ(test::sample(out[2], 0, x, y), test::sample(in[2], 0, x, y));
  }
  int changed = 0;
  for (int x = 10; x < 50; ++x) changed += test::sample(out[2], 0, x, 30) != test::sample(in[2], 0, x, 30);
  EXPECT_GT(changed, 36);
}

TEST(DrawnWater, FlowsFromFrameToFrame) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 6);
  folder.render(water_scene + "[output]\nimages = \"unused/%d.png\"\ncontent = \"cg\"\n",
                {.output = "out.mkv", .codec = "ffv1"});
  const auto out = folder.frames("out.mkv");
  EXPECT_GT(changed_samples(out[1], out[2]), 200u);
}

TEST(DrawnWater, TwoRendersAreIdenticalAndAPartIsThatOfTheWhole) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 30);
  // What is filmed is noise here: mirrored, it would tell the frame at which a key was taken.
  std::string scene = water_scene;
  scene.replace(scene.find("strokes = 400\n"), 14, "strokes = 400\nmirror = { plate = false }\n");
  scene += "[output]\nimages = \"unused/%d.png\"\ncontent = \"cg\"\n";
  folder.render(scene, {.output = "a.mkv", .codec = "ffv1"});
  folder.render(scene, {.output = "b.mkv", .codec = "ffv1"});
  folder.render(scene, {.output = "part.mkv", .codec = "ffv1", .first_frame = 20, .end_frame = 25});
  const auto a = folder.frames("a.mkv"), b = folder.frames("b.mkv"), part = folder.frames("part.mkv");
  ASSERT_EQ(part.size(), 5u);
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_EQ(changed_samples(a[i], b[i]), 0u);
  for (std::size_t i = 0; i < part.size(); ++i) {
    const auto x = test::samples(part[i]), y = test::samples(a[20 + i]);
    for (std::size_t k = 0; k < x.size(); ++k) ASSERT_NEAR(x[k], y[k], 1);
  }
}

// What is filmed is noise, so that each frame tells which one it mirrors.
void expect_part_as_in_the_whole(const std::string& colours) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 50);
  std::string scene = water_scene;
  scene.replace(scene.find("strokes = 400\n"), 14,
                "strokes = 400\nmirror = { surroundings_m = 3 }\ncolours = " + colours + "\n");
  scene += "[output]\nimages = \"unused/%d.png\"\ncontent = \"cg\"\n";
  folder.render(scene, {.output = "whole.mkv", .codec = "ffv1", .overwrite = true});
  const auto whole = folder.frames("whole.mkv");
  std::int64_t mirrored = 0;
  for (const std::int64_t first : {3, 26, 47}) {
    const auto report = folder.render(
        scene,
        {.output = "part.mkv", .codec = "ffv1", .first_frame = first, .end_frame = first + 2, .overwrite = true});
    EXPECT_EQ(report.frames, 2);
    for (const StageReport& stage : report.stages) EXPECT_EQ(stage.times.count(), 2) << stage.name;
    const auto part = folder.frames("part.mkv");
    ASSERT_EQ(part.size(), 2u);
    for (std::size_t i = 0; i < part.size(); ++i) {
      const auto x = test::samples(part[i]), y = test::samples(whole[static_cast<std::size_t>(first) + i]);
      for (std::size_t k = 0; k < x.size(); ++k) ASSERT_NEAR(x[k], y[k], 1) << colours << ", frame " << first;
      const auto z = test::samples(whole[0]);
      for (std::size_t k = 0; k < x.size(); ++k) mirrored += std::abs(x[k] - z[k]) > 8;
    }
  }
  EXPECT_GT(mirrored, 1000);
}

TEST(DrawnWater, APartThatMirrorsWhatIsFilmedIsThatOfTheWhole) {
  expect_part_as_in_the_whole("{ key_frames = 5 }");
  expect_part_as_in_the_whole("{ method = \"followed\" }");
  expect_part_as_in_the_whole("{ method = \"sampled\" }");
}

TEST(DrawnWater, StandsAroundObjectsAndMirrorsThem) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 2);
  const std::string red = test::cube + "colour = \"#ff0000\"\ntoon = false\n";
  std::string calm = water_scene;
  calm.erase(calm.find("[[water.surface.arrow]]"));
  calm.replace(
      calm.find("strokes = 400\n"), 14,
      "strokes = 3000\nwaterline = false\nmirror = { plate = false, zenith = \"#00ff00\", horizon = \"#00ff00\" }\n");
  folder.render(calm + red + "[output]\nimages = \"unused/%d.png\"\ncontent = \"cg\"\n",
                {.output = "out.mkv", .codec = "ffv1"});
  const Frame frame = folder.frames("out.mkv")[1];
  const auto component = [&](int c, int x, int y) { return test::sample(frame, c, x, y); };
  // The cube stands from z = 0 to 0.5 around x = 0: find its red column, then look below its waterline.
  int top = -1, bottom = -1, column = -1;
  for (int x = 8; x < 56 && column < 0; ++x) {
    for (int y = 0; y < 48; ++y) {
      if (component(0, x, y) > 250 && component(1, x, y) < 5) {
        if (top < 0) top = y;
        bottom = y;
      }
    }
    if (bottom - top >= 6)
      column = x + 2;
    else
      top = bottom = -1;
  }
  ASSERT_GT(column, 0);
  bottom = 0;
  for (int y = 0; y < 48; ++y) {
    if (component(0, column, y) > 250 && component(1, column, y) < 5) bottom = y;
  }
  int mirrored_red = 0, open_red = 0;
  for (int y = bottom + 2; y < bottom + 5; ++y) mirrored_red += component(0, column, y);
  for (int y = bottom + 2; y < bottom + 5; ++y) open_red += component(0, 2, y);
  EXPECT_GT(mirrored_red, open_red + 3 * 40);
}

TEST(DrawnWater, AnArrowInTheSkyIsRefused) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 2);
  try {
    folder.render(water_scene + "[[water.surface.arrow]]\nfrom_px = [10, 1]\nto_px = [20, 1]\n", {.output = "out.mkv"});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_status(), 2);
    EXPECT_NE(std::string(error.what()).find("horizon"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out.mkv"));
}

// Behind the camera, and level with its eye.
TEST(DrawnWater, ThatIsNotSeenIsSaidToBe) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 1);
  for (const std::string corners : {"[-1, -6, 0], [1, -6, 0], [1, -4, 0]", "[-1, 0, 1], [1, 0, 1], [1, 2, 1]"}) {
    const RenderReport report =
        folder.render(test::plate + test::locked + "[water]\n[[water.surface]]\noutline_m = [" + corners + "]\n",
                      {.output = "out.mkv", .overwrite = true});
    const bool said = std::ranges::any_of(report.notices, [](const std::string& notice) {
      return notice.find("nothing of this water is seen") != std::string::npos;
    });
    EXPECT_TRUE(said) << corners;
  }
}

TEST(DrawnWater, ASceneWithoutItMakesNoneOfIt) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 2);
  const gl::Made dry = test::made_by(folder, test::drawn_scene), wet = test::made_by(folder, test::drawn_scene + basin);
  EXPECT_GT(wet.programs, dry.programs);
  EXPECT_GT(wet.buffers, dry.buffers);
  // Shading and its feather: nothing of water.
  EXPECT_EQ(dry.programs, test::made_by(folder, test::drawn_scene).programs);
}

}  // namespace
}  // namespace rinkaku::pipeline
