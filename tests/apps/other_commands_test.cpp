// explain, inspect, board, calibrate and the help texts.
#include <set>

#include "tests/apps/cli_tools.h"

namespace rinkaku {
namespace {

namespace fs = std::filesystem;
using test::contains;

const PictureFormat small = test::picture("yuv420p", 64, 48, test::bt709_limited);

TEST(ExplainCommand, JsonTellsEachStageAndWhy) {
  const test::ShotFolder folder;
  folder.noise_clip("in.mkv", small, 1);
  folder.write("scene.toml", test::drawn_scene);
  const test::CliResult got = test::run_rinkaku(folder, "explain scene.toml --json");
  EXPECT_EQ(got.status, 0);
  const auto plan = test::json_of(got.out);
  std::set<std::string> runs;
  for (const auto& stage : plan.at("stages")) {
    EXPECT_FALSE(stage.at("why").get<std::string>().empty()) << stage;
    if (stage.at("runs").get<bool>()) runs.insert(stage.at("name").get<std::string>());
  }
  EXPECT_EQ(runs, (std::set<std::string>{"decode", "track", "import", "toon", "draw", "composite", "copy-streams",
                                         "encode"}));
}

// What explain says runs is what render then runs, so far as it is timed by frame.
TEST(ExplainCommand, AgreesWithRender) {
  const test::ShotFolder folder;
  folder.write("camera.yml", test::ShotFolder::camera_text(64, 48, "-0.2, 0, 0, 0, 0"));
  folder.noise_clip("in.mkv", small, 2);
  folder.write("scene.toml", test::drawn_scene);
  const std::set<std::string> within_others{"import", "toon", "flat", "outline", "smooth", "copy-streams"};
  std::set<std::string> explained, rendered;
  const auto plan = test::json_of(test::run_rinkaku(folder, "explain scene.toml --layers --json").out);
  for (const auto& stage : plan.at("stages")) {
    const std::string name = stage.at("name");
    if (stage.at("runs").get<bool>() && !within_others.contains(name)) explained.insert(name);
  }
  const auto report =
      test::json_of(test::run_rinkaku(folder, "render scene.toml -o out.mkv --layers layers --json").out);
  for (const auto& stage : report.at("stages")) rendered.insert(stage.at("name").get<std::string>());
  EXPECT_EQ(explained, rendered);
  EXPECT_TRUE(rendered.contains("lens"));
}

TEST(ExplainCommand, DotIsAGraph) {
  const test::ShotFolder folder;
  folder.noise_clip("in.mkv", small, 1);
  folder.write("scene.toml", test::drawn_scene);
  const test::CliResult got = test::run_rinkaku(folder, "explain scene.toml --dot");
  EXPECT_EQ(got.status, 0);
  EXPECT_EQ(got.out.rfind("digraph", 0), 0u);
  EXPECT_TRUE(contains(got.out, "\"draw\" -> \"composite\""));
}

TEST(ExplainCommand, TextHasALineForEachStage) {
  const test::ShotFolder folder;
  folder.noise_clip("in.mkv", small, 1);
  folder.write("scene.toml", test::plate);
  const test::CliResult got = test::run_rinkaku(folder, "explain scene.toml");
  EXPECT_EQ(got.status, 0);
  EXPECT_TRUE(contains(got.out, "runs  encode")) << got.out;
  EXPECT_TRUE(contains(got.out, "-     draw")) << got.out;
}

// Names are bytes; JSON is UTF-8.
TEST(ExplainCommand, JsonIsValidWhateverTheNames) {
  const test::ShotFolder folder;
  folder.noise_clip("in.mkv", small, 1);
  fs::rename(folder / "in.mkv", folder / "caf\xe9.mkv");
  folder.write("scene.toml", "[plate]\nimages = \"caf?.mkv\"\n");
  folder.write("empty.toml", test::plate);
  const test::CliResult got =
      test::run_rinkaku(folder, "render empty.toml --input caf\xe9.mkv -o caf\xe9_out.mkv --codec ffv1 --json");
  EXPECT_EQ(got.status, 0) << got.err;
  EXPECT_EQ(test::json_of(got.out).at("output"), "caf\xef\xbf\xbd_out.mkv");
}

TEST(InspectCommand, JsonDescribesAClosedCube) {
  const test::ShotFolder folder;
  const test::CliResult got = test::run_rinkaku(folder, "inspect cube.obj --json");
  EXPECT_EQ(got.status, 0);
  EXPECT_EQ(got.err, "");
  const auto found = test::json_of(got.out);
  EXPECT_EQ(found.at("triangles"), 12);
  EXPECT_GE(found.at("vertices"), 8);
  EXPECT_EQ(found.at("closed"), true);
  EXPECT_EQ(found.at("manifold"), true);
  EXPECT_EQ(found.at("two_sided"), 0);
  EXPECT_EQ(found.at("degenerate"), 0);
  EXPECT_EQ(found.at("skins"), 0);
  EXPECT_TRUE(found.at("clips").is_array());
  EXPECT_EQ(found.at("matte").at("single_sided_components"), 1);
  EXPECT_EQ(found.at("matte").at("two_sided_components"), 0);
}

TEST(InspectCommand, SaysWhatIsOpen) {
  const test::ShotFolder folder;
  folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
  EXPECT_EQ(test::json_of(test::run_rinkaku(folder, "inspect --json open.obj").out).at("closed"), false);
  const test::CliResult text = test::run_rinkaku(folder, "inspect open.obj");
  EXPECT_TRUE(contains(text.out, "triangles              2")) << text.out;
  EXPECT_TRUE(contains(text.out, "1 part of 2 triangles drawn from both sides")) << text.out;
}

TEST(InspectCommand, TellsSkinsAndClipsOfARealModel) {
  RINKAKU_NEEDS_DATA();
  const fs::path fox = test::data("meshes/animated/Fox.glb");
  const test::ShotFolder folder;
  const auto found = test::json_of(test::run_rinkaku(folder, "inspect --json '" + fox.string() + "'").out);
  EXPECT_EQ(found.at("skins"), 1);
  EXPECT_EQ(found.at("skin_names").size(), 1u);
  EXPECT_EQ(found.at("bones"), 24);
  EXPECT_EQ(found.at("clips").size(), 3u);
}

TEST(BoardCommand, MakesAPdfOfTheSizeAskedFor) {
  const test::ShotFolder folder;
  folder.write("board.toml", test::board_toml);
  const test::CliResult got = test::run_rinkaku(folder, "board board.toml -o board.pdf --page 200x150 --json");
  EXPECT_EQ(got.status, 0) << got.err;
  const auto report = test::json_of(got.out);
  EXPECT_DOUBLE_EQ(report.at("page_width_m"), 0.2);
  EXPECT_DOUBLE_EQ(report.at("page_height_m"), 0.15);
  EXPECT_EQ(report.at("markers"), 4);
  const std::string pdf = test::text_of(folder / "board.pdf");
  EXPECT_EQ(pdf.rfind("%PDF-", 0), 0u);
  EXPECT_TRUE(contains(pdf.substr(pdf.size() - 10), "%%EOF"));
}

TEST(BoardCommand, TakesTheSmallestPageThatFits) {
  const test::ShotFolder folder;
  folder.write("board.toml", test::board_toml);
  const auto report = test::json_of(test::run_rinkaku(folder, "board board.toml -o board.pdf --json").out);
  EXPECT_DOUBLE_EQ(report.at("page_width_m"), 0.21);  // A4
}

class HelpOf : public testing::TestWithParam<const char*> {};

TEST_P(HelpOf, HasAnExampleOfTheCommand) {
  const test::ShotFolder folder;
  const std::string command = GetParam();
  const test::CliResult got = test::run_rinkaku(folder, command + " --help");
  EXPECT_EQ(got.status, 0);
  EXPECT_EQ(got.err, "");
  EXPECT_TRUE(contains(got.out, "Example:\n  rinkaku " + command + " ")) << got.out;
  EXPECT_TRUE(contains(got.out, "--json")) << got.out;
}
INSTANTIATE_TEST_SUITE_P(Commands, HelpOf,
                         testing::Values("render", "explain", "inspect", "board", "calibrate", "curvature"));

TEST(Cli, HelpListsTheCommands) {
  const test::ShotFolder folder;
  const test::CliResult got = test::run_rinkaku(folder, "--help");
  EXPECT_EQ(got.status, 0);
  for (const char* command : {"render", "explain", "inspect", "board", "calibrate", "curvature"}) {
    EXPECT_TRUE(contains(got.out, std::string("  ") + command)) << command;
  }
}

TEST(Cli, VersionIsOneLine) {
  const test::ShotFolder folder;
  const test::CliResult got = test::run_rinkaku(folder, "--version");
  EXPECT_EQ(got.status, 0);
  EXPECT_EQ(got.out.rfind("rinkaku ", 0), 0u);
}

// Photographs of a real chessboard.
TEST(CalibrateCommand, WritesACameraFile) {
  RINKAKU_NEEDS_DATA();
  const test::ShotFolder folder;
  folder.write("board.toml", "chessboard = { columns = 10, rows = 7, square_m = 0.025 }\n");
  const test::CliResult got =
      test::run_rinkaku(folder, "calibrate '" + test::data("calibration/chessboard_left/left*.jpg").string() +
                                    "' --board board.toml -o new.yml --json");
  ASSERT_EQ(got.status, 0) << got.err;
  const auto report = test::json_of(got.out);
  EXPECT_LT(report.at("rms_px"), 1);  // OpenCV's own sample reports 0.4 on these
  EXPECT_TRUE(fs::exists(folder / "new.yml"));
}

}  // namespace
}  // namespace rinkaku
