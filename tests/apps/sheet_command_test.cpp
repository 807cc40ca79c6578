#include "tests/apps/cli_tools.h"

namespace rinkaku {
namespace {

using test::contains;

TEST(SheetCommand, DrawsTheChosenStylesSideBySide) {
  const test::ShotFolder folder;
  const test::CliResult got = test::run_rinkaku(
      folder, "sheet cube.obj -o sheet.png --cell-px 100 --columns 2 --styles none,hull,strokes --json");
  ASSERT_EQ(got.status, 0) << got.err;
  const auto told = test::json_of(got.out);
  EXPECT_EQ(told.at("styles"), (std::vector<std::string>{"none", "hull", "strokes"}));
  const std::vector<Frame> frames = folder.frames("sheet.png");
  ASSERT_EQ(frames.size(), 1u);
  const PictureFormat& format = frames[0].format;
  EXPECT_EQ(format.width_px, 200);
  // Two rows of pictures, each with its label below.
  EXPECT_GT(format.height_px, 200);
  const int row_px = format.height_px / 2;
  const auto dark_px = [&](int column, int row) {
    int dark = 0;
    for (int y = row * row_px; y < row * row_px + 100; ++y) {
      const std::uint8_t* in = frames[0].planes[0].data + y * frames[0].planes[0].stride_bytes;
      for (int x = 100 * column; x < 100 * column + 100; ++x) {
        dark += in[x * format.pixels.component[0].step_bytes] < 60 ? 1 : 0;
      }
    }
    return dark;
  };
  EXPECT_EQ(dark_px(0, 0), 0) << "without a line nothing is dark";
  EXPECT_GT(dark_px(1, 0), 100) << "a line around 200 px long and 3 wide, thinner at hard edges";
  EXPECT_GT(dark_px(0, 1), 100);
  EXPECT_EQ(dark_px(1, 1), 0) << "no fourth style";
}

TEST(SheetCommand, ShowsAMomentOfAClip) {
  RINKAKU_NEEDS_DATA();
  const test::ShotFolder folder;
  const std::string sheet =
      "sheet " + test::data("meshes/animated/Fox.glb").string() + " -o fox.png --force --styles hull";
  const auto shown = [&](const std::string& moment) {
    const test::CliResult got = test::run_rinkaku(folder, sheet + moment);
    EXPECT_EQ(got.status, 0) << got.err;
    return test::samples(folder.frames("fox.png").at(0));
  };
  const std::string rest = shown(""), run = shown(" --clip Run --time-s 0.3");
  EXPECT_NE(run, rest);
  EXPECT_NE(run, shown(" --clip Run --time-s 0.6"));
  EXPECT_NE(run, shown(" --time-s 0.3")) << "of its first clip";
  EXPECT_EQ(run, shown(" --clip Run --time-s 0.3"));
  const test::CliResult unknown = test::run_rinkaku(folder, sheet + " --clip Fly");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_TRUE(contains(unknown.err, "no clip \"Fly\"") && contains(unknown.err, "\"Run\"")) << unknown.err;
}

TEST(SheetCommand, BadCallsSayOneLineAndWriteNothing) {
  const test::ShotFolder folder;
  folder.write("kept.png", "kept");
  const auto before = test::contents(folder.path());
  const std::pair<const char*, const char*> calls[] = {
      {"sheet cube.obj -o new.png --styles hull,fancy", "there is no style 'fancy'"},
      {"sheet cube.obj -o kept.png", "kept.png"},
      {"sheet cube.obj -o new.jpg", "new.jpg"},
      {"sheet gone.obj -o new.png", "gone.obj"},
      {"sheet cube.obj -o new.png --columns 0", "--columns"},
      {"sheet cube.obj", "--output"},
      {"sheet cube.obj -o new.png --clip Run", "cube.obj has no animation"},
  };
  for (const auto& [call, part] : calls) {
    const test::CliResult got = test::run_rinkaku(folder, call);
    EXPECT_EQ(got.status, 2) << call;
    EXPECT_TRUE(contains(got.err, part)) << call << ": " << got.err;
    EXPECT_EQ(std::count(got.err.begin(), got.err.end(), '\n'), 1) << got.err;
    EXPECT_EQ(test::contents(folder.path()), before) << call;
  }
}

TEST(RenderCommand, EveryStyleOfLineIsDrawnIntoTheVideo) {
  const test::ShotFolder folder;
  folder.noise_clip("in.mkv", test::picture("yuv420p", 64, 48, test::bt709_limited), 2);
  const auto rendered = [&](const std::string& line) {
    folder.write("scene.toml", test::drawn_scene + line);
    const test::CliResult got = test::run_rinkaku(folder, "render scene.toml -o out.mkv --codec ffv1 --force");
    EXPECT_EQ(got.status, 0) << line << got.err;
    return test::samples(folder.frames("out.mkv").at(1));
  };
  std::map<std::string, std::string> known = {{rendered(""), "none"}};
  for (const char* method : {"uniform", "hull", "depth_normals", "silhouette", "laplacian", "z_lines", "hidden_lines",
                             "isophote", "wobble", "strokes"}) {
    const auto [at, added] =
        known.try_emplace(rendered(std::string("outline = { method = \"") + method + "\" }\n"), method);
    EXPECT_TRUE(added) << method << " draws what " << at->second << " draws";
  }
}

TEST(RenderCommand, BrushThatIsNoPictureIsNamed) {
  const test::ShotFolder folder;
  folder.noise_clip("in.mkv", test::picture("yuv420p", 64, 48, test::bt709_limited), 1);
  folder.write("brush.png", "no picture");
  folder.write("scene.toml", test::drawn_scene + "outline = { method = \"strokes\", brush = \"brush.png\" }\n");
  const test::CliResult got = test::run_rinkaku(folder, "render scene.toml -o out.mkv");
  EXPECT_EQ(got.status, 2);
  EXPECT_TRUE(contains(got.err, "brush.png: no picture of it can be decoded")) << got.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out.mkv"));
}

}  // namespace
}  // namespace rinkaku
