#include "tests/apps/cli_tools.h"

namespace rinkaku {
namespace {

using test::contains;
using test::sample;

const PictureFormat picture = test::picture("yuv420p", 128, 96, test::bt709_limited);

// A shot of a cube in the middle of the picture, seen through a lens.
class TraceCommand : public testing::Test {
 protected:
  TraceCommand() : folder(128, 96) {
    folder.write("camera.yml", test::ShotFolder::camera_text(128, 96, "-0.3, 0, 0, 0, 0"));
    folder.noise_clip("in.mkv", picture, 3);
    folder.write("scene.toml", test::drawn_scene);
    folder.write("drawn.txt", "# across the cube\n55,47 62,49 69,46\n");
  }
  test::ShotFolder folder;
};

TEST_F(TraceCommand, LineIsRenderedWhereItWasDrawn) {
  const test::CliResult traced =
      test::run_rinkaku(folder, "trace scene.toml --frame 1 --lines drawn.txt -o marks.csv --json");
  ASSERT_EQ(traced.status, 0) << traced.err;
  EXPECT_EQ(test::json_of(traced.out).at("lines"), 1);
  folder.write("scene.toml",
               test::drawn_scene +
                   "colour = \"#ffffff\"\ntoon = false\n"
                   "outline = { width_px = 3, taper_px = 0, colour = \"#ff0000\", drawn = \"marks.csv\" }\n");
  const test::CliResult rendered =
      test::run_rinkaku(folder, "render scene.toml -o out.mkv --codec ffv1 --layers layers");
  ASSERT_EQ(rendered.status, 0) << rendered.err;
  const Frame layer = folder.frames("layers/cg_000002.png").at(0);
  const auto is_red = [&](int x, int y) { return sample(layer, 0, x, y) > 200 && sample(layer, 1, x, y) < 90; };
  for (const auto& [x, y] : {std::pair(57, 47), {62, 49}, {66, 47}}) EXPECT_TRUE(is_red(x, y)) << x << ", " << y;
  for (const auto& [x, y] : {std::pair(62, 44), {62, 53}}) EXPECT_FALSE(is_red(x, y)) << x << ", " << y;
}

TEST_F(TraceCommand, BadCallsSayOneLineAndWriteNothing) {
  folder.write("words.txt", "55,47 here\n");
  folder.write("odd.txt", "55,47 62\n");
  folder.write("point.txt", "\n55,47\n");
  folder.write("none.txt", "# nothing\n");
  folder.write("beside.txt", "2,2 9,9\n");
  folder.write("empty.toml", "[plate]\nvideo = \"in.mkv\"\n");
  folder.write("kept.csv", "kept");
  const auto before = test::contents(folder.path());
  const std::pair<const char*, const char*> calls[] = {
      {"scene.toml --frame 1 --lines words.txt -o new.csv", "words.txt:1: is no line"},
      {"scene.toml --frame 1 --lines odd.txt -o new.csv", "odd.txt:1: is no line"},
      {"scene.toml --frame 1 --lines point.txt -o new.csv", "point.txt:2: a line needs two points"},
      {"scene.toml --frame 1 --lines none.txt -o new.csv", "none.txt: holds no lines"},
      {"scene.toml --frame 1 --lines gone.txt -o new.csv", "gone.txt"},
      {"scene.toml --frame 1 --lines beside.txt -o new.csv", "no line meets 'cube.obj' in frame 1"},
      {"scene.toml --frame 3 --lines drawn.txt -o new.csv", "has 3 frames, and none with the number 3"},
      {"scene.toml --frame 1 --lines drawn.txt -o kept.csv", "kept.csv"},
      {"scene.toml --frame 1 --lines drawn.txt --object dog -o new.csv", "has no object 'dog'"},
      {"empty.toml --frame 1 --lines drawn.txt -o new.csv", "has no [[object]] to draw on"},
      {"scene.toml --lines drawn.txt -o new.csv", "--frame"},
  };
  for (const auto& [call, part] : calls) {
    const test::CliResult got = test::run_rinkaku(folder, std::string("trace ") + call);
    EXPECT_EQ(got.status, 2) << call;
    EXPECT_TRUE(contains(got.err, part)) << call << ": " << got.err;
    EXPECT_EQ(std::count(got.err.begin(), got.err.end(), '\n'), 1) << got.err;
    EXPECT_EQ(test::contents(folder.path()), before) << call;
  }
}

TEST_F(TraceCommand, MarksOfAnotherMeshAndBrokenOnesAreRefused) {
  const std::pair<const char*, const char*> files[] = {
      {"triangles,13\nline,triangle,b,c\n", "was made for another mesh, not for one of 12 triangles"},
      {"points\n", "holds no lines on a mesh"},
      {"triangles,12\nline,triangle,b,c\n0,12,0,0\n", "marks.csv:3: is no place on the mesh"},
      {"triangles,12\nline,triangle,b,c\n0,1,0.5,0.7\n", "marks.csv:3: is no place on the mesh"},
      {"triangles,12\nline,triangle,b,c\n0,1,nan,0\n", "marks.csv:3: is no place on the mesh"},
      {"triangles,12\nline,triangle,b,c\n4,1,0,0\n", "marks.csv:3: is no place on the mesh"},
  };
  folder.write("scene.toml", test::drawn_scene + "outline = { drawn = \"marks.csv\" }\n");
  for (const auto& [text, part] : files) {
    folder.write("marks.csv", text);
    const test::CliResult got = test::run_rinkaku(folder, "render scene.toml -o out.mkv");
    EXPECT_EQ(got.status, 2) << text;
    EXPECT_TRUE(contains(got.err, part)) << got.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "out.mkv"));
  }
}

}  // namespace
}  // namespace rinkaku
