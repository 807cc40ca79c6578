// Wrong calls and wrong files: one line that names the culprit, exit status 2, nothing written.
#include "tests/apps/cli_tools.h"

namespace rinkaku {
namespace {

namespace fs = std::filesystem;
using test::contains;

const PictureFormat small = test::picture("yuv420p", 64, 48, test::bt709_limited);

// A folder with a good shot and everything that the bad calls name.
class BadCallFolder : public test::ShotFolder {
 public:
  BadCallFolder() {
    noise_clip("in.mkv", small, 3);
    write("good.toml", test::plate);
    write("drawn.toml", test::drawn_scene);
    write("misspelt.toml", test::drawn_scene + "outlin = true\n");
    write("wrong_type.toml", test::drawn_scene + "name = 3\n");
    write("nan.toml", test::plate + test::locked + "[[object]]\nmesh = \"cube.obj\"\nposition_m = [0, nan, 0]\n");
    write("negative.toml", test::plate + test::locked + "[[object]]\nmesh = \"cube.obj\"\nheight_m = -1\n");
    write("no_video.toml", "[plate]\nvideo = \"gone.mkv\"\n");
    write("text_video.toml", "[plate]\nvideo = \"text.mp4\"\n");
    write("text.mp4", "This is no video at all.\n");
    write("empty.mp4", "");
    write("empty_video.toml", "[plate]\nvideo = \"empty.mp4\"\n");
    write("large.yml", camera_text(640, 480));
    write("large.toml", "[plate]\nvideo = \"in.mkv\"\ncamera = \"large.yml\"\n" + test::locked + test::cube);
    std::string fisheye = camera_text(64, 48, "0, 0, 0, 0, 0");
    write("fisheye.yml", fisheye + "distortion_model: \"fisheye\"\n");
    write("fisheye.toml", "[plate]\nvideo = \"in.mkv\"\ncamera = \"fisheye.yml\"\n" + test::locked + test::cube);
    write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    write("points.toml", object_of("points.obj"));
    write("no_mesh.toml", object_of("gone.obj"));
    write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n");
    write("flat.toml", object_of("flat.obj") + "height_m = 1\n");
    write("marker.toml",
          test::plate + "[track]\nmarker = { dictionary = \"4X4_50\", id = 7, size_m = 0.1 }\n" + test::cube);
    write("poses.csv", "frame,tx,ty,tz,qx,qy,qz,qw\n0,0,0,oops,0,0,0,1\n");
    write("poses.toml", test::plate + test::poses + test::cube);
    write("to_stdout.toml", test::plate + "[output]\nvideo = \"-\"\n");
    write("board.toml", test::board_toml);
    write("bad_board.toml", "dictionary = \"4X4_50\"\ngrid = { columns = 2, rows = 2, size_m = 0.04, gap = 0.01 }\n");
    write("exists.mkv", "kept");
    write("exists.json", "kept");
    write("exists.pdf", "kept");
    fs::create_directory(*this / "folder");
    fs::create_directories(*this / "layers");
    write("layers/cg_000001.png", "kept");
  }

 private:
  static std::string object_of(const std::string& mesh) {
    return test::plate + test::locked + "[[object]]\nmesh = \"" + mesh + "\"\n";
  }
};

struct BadCall {
  const char* name;
  const char* arguments;
  const char* culprit;  // what the line must name
};

void PrintTo(const BadCall& call, std::ostream* out) { *out << call.arguments; }

class BadCalls : public testing::TestWithParam<BadCall> {};

TEST_P(BadCalls, GetOneLineAndStatus2AndLeaveNothing) {
  const BadCallFolder folder;
  const auto before = test::contents(folder.path());
  const test::CliResult got = test::run_rinkaku(folder, GetParam().arguments);
  EXPECT_EQ(got.status, 2);
  EXPECT_EQ(got.out, "");
  EXPECT_EQ(got.err.rfind("rinkaku: ", 0), 0u) << got.err;
  EXPECT_EQ(std::count(got.err.begin(), got.err.end(), '\n'), 1) << got.err;
  EXPECT_TRUE(got.err.ends_with("\n"));
  EXPECT_TRUE(contains(got.err, GetParam().culprit)) << got.err;
  EXPECT_TRUE(test::contents(folder.path()) == before);
}

const BadCall calls[] = {
    {"NoArguments", "", "no command"},
    {"UnknownCommand", "rendr good.toml", "'rendr'"},
    {"UnknownOption", "render good.toml -o out.mkv --fast", "--fast"},
    {"UnknownOptionBeforeCommand", "--fast render good.toml", "--fast"},
    {"TooManyArguments", "render good.toml drawn.toml -o out.mkv", "drawn.toml"},
    {"LineEndInArgument", "render \"no\nsuch.toml\" -o out.mkv", "such.toml"},
    {"RenderWithoutScene", "render", "SCENE"},
    {"MissingScene", "render gone.toml -o out.mkv", "gone.toml"},
    {"SceneIsAFolder", "render folder -o out.mkv", "folder"},
    {"SceneIsAVideo", "render in.mkv -o out.mkv", "in.mkv"},
    {"MisspeltKey", "render misspelt.toml -o out.mkv", "did you mean 'outline'?"},
    {"WrongType", "render wrong_type.toml -o out.mkv", "'name'"},
    {"NaN", "render nan.toml -o out.mkv", "position_m"},
    {"NegativeSize", "render negative.toml -o out.mkv", "height_m"},
    {"MissingVideo", "render no_video.toml -o out.mkv", "gone.mkv"},
    {"TextAsVideo", "render text_video.toml -o out.mkv", "text.mp4"},
    {"EmptyVideo", "render empty_video.toml -o out.mkv", "empty.mp4"},
    {"MissingInput", "render good.toml --input gone.mkv -o out.mkv", "gone.mkv"},
    {"CameraOfAnotherSize", "render large.toml -o out.mkv", "640x480"},
    {"FisheyeCamera", "render fisheye.toml -o out.mkv", "fisheye"},
    {"MeshWithoutFaces", "render points.toml -o out.mkv", "points.obj"},
    {"MissingMesh", "render no_mesh.toml -o out.mkv", "gone.obj"},
    {"HeightOfAFlatMesh", "render flat.toml -o out.mkv", "flat.obj"},
    {"MarkerNeverSeen", "render marker.toml -o out.mkv", "marker 7 of 4X4_50 was not seen"},
    {"MarkerNeverSeenWithLayers", "render marker.toml -o out.mkv --layers new/layers", "marker 7 of 4X4_50"},
    {"BrokenPoses", "render poses.toml -o out.mkv", "poses.csv:2"},
    {"NoOutput", "render good.toml", "good.toml: names no output"},
    {"OutputExists", "render good.toml -o exists.mkv", "exists.mkv: exists already"},
    {"OutputExistsWithLayers", "render drawn.toml -o exists.mkv --layers new", "exists.mkv"},
    {"OutputFolderMissing", "render good.toml -o gone/out.mkv", "gone"},
    {"OutputIsAFolder", "render good.toml -o folder", "folder"},
    {"OutputWithoutEnding", "render good.toml -o out", "out"},
    {"OutputIsTheInput", "render good.toml -o in.mkv", "in.mkv: is the input itself"},
    {"OutputIsTheInputByForce", "render good.toml -o in.mkv --force", "in.mkv: is the input itself"},
    {"OutputIsTheInputInPart", "render good.toml -o ./folder/../in.mkv --force --frames 0:2", "is the input itself"},
    {"UnknownCodec", "render good.toml -o out.mkv --codec ffv7", "ffv7"},
    {"CodecThatTheContainerRefuses", "render good.toml -o out.mp4 --codec ffvhuff", "ffvhuff"},
    {"FramesWithoutColon", "render good.toml -o out.mkv --frames 5", "--frames: '5'"},
    {"FramesOfWords", "render good.toml -o out.mkv --frames a:b", "--frames: 'a:b'"},
    {"FramesBackwards", "render good.toml -o out.mkv --frames 2:1", "--frames: '2:1'"},
    {"FramesEmpty", "render good.toml -o out.mkv --frames 2:2", "--frames: '2:2'"},
    {"FramesNegative", "render good.toml -o out.mkv --frames -1:2", "--frames"},
    {"FramesTooLarge", "render good.toml -o out.mkv --frames 0:99999999999999999999", "--frames"},
    {"FramesThrice", "render good.toml -o out.mkv --frames 0:1:2", "--frames: '0:1:2'"},
    {"FramesPastTheEnd", "render good.toml -o out.mkv --frames 3:9", "in.mkv: it has 3 frames"},
    {"BitRateZero", "render good.toml -o out.mkv --bit-rate 0", "--bit-rate"},
    {"BitRateOfWords", "render good.toml -o out.mkv --bit-rate much", "--bit-rate"},
    {"PipeWithJson", "render good.toml -o - --format y4m --json", "--json"},
    {"ScenePipesWithJson", "render to_stdout.toml --format y4m --json", "--json"},
    {"PipeWithoutFormat", "render good.toml -o -", "y4m or raw"},
    {"UnknownFormat", "render good.toml -o - --format avi", "--format"},
    {"FormatOfAFile", "render good.toml -o out.mkv --format y4m", "--format"},
    {"LayersInAFile", "render drawn.toml -o out.mkv --layers text.mp4", "text.mp4"},
    {"LayersWhereNothingCanBeMade", "render drawn.toml -o out.mkv --layers /proc/rinkaku", "/proc/rinkaku"},
    {"LayersExist", "render drawn.toml -o out.mkv --layers layers", "layers/cg_000001.png"},
    {"TimingsExist", "render good.toml -o out.mkv --timings exists.json", "exists.json"},
    {"TimingsInAMissingFolder", "render good.toml -o out.mkv --timings gone/t.json", "gone/t.json"},
    {"TimingsAreAFolder", "render good.toml -o out.mkv --timings folder --force", "folder"},
    {"TimingsAreTheOutput", "render good.toml -o out.mkv --timings ./out.mkv", "out.mkv"},
    {"ExplainMissingScene", "explain gone.toml", "gone.toml"},
    {"ExplainMisspeltKey", "explain misspelt.toml", "outlin"},
    {"InspectMissingMesh", "inspect gone.obj", "gone.obj"},
    {"InspectNoMesh", "inspect text.mp4", "text.mp4"},
    {"InspectNoFaces", "inspect points.obj", "points.obj"},
    {"InspectNothing", "inspect", "MESH"},
    {"BoardMissing", "board gone.toml -o out.pdf", "gone.toml"},
    {"BoardMisspeltKey", "board bad_board.toml -o out.pdf", "gap_m"},
    {"BoardWithoutOutput", "board board.toml", "--output"},
    {"BoardOutputExists", "board board.toml -o exists.pdf", "exists.pdf"},
    {"BoardFolderMissing", "board board.toml -o gone/out.pdf", "gone/out.pdf"},
    {"BoardUnknownPage", "board board.toml -o out.pdf --page A9", "'A9'"},
    {"BoardPageTooSmall", "board board.toml -o out.pdf --page 30x30", "board.toml"},
    {"CalibrateWithoutBoard", "calibrate in.mkv -o out.yml", "--board"},
    {"CalibrateMissingVideo", "calibrate gone.mkv --board board.toml -o out.yml", "gone.mkv"},
    {"BakeMissingMesh", "bake gone.obj -o out.rgn", "gone.obj"},
    {"BakeNoFaces", "bake points.obj -o out.rgn", "points.obj"},
    {"BakeWithoutOutput", "bake flat.obj", "--output"},
    {"BakeOutputExists", "bake flat.obj -o exists.pdf", "exists.pdf"},
    {"BakeOverItsMesh", "bake flat.obj -o flat.obj --force", "flat.obj"},
    {"BakeTooManyCells", "bake flat.obj -o out.rgn --cells 65", "--cells"},
    {"BakeInnerTooSmall", "bake flat.obj -o out.rgn --inner 1", "--inner"},
    {"MatteEyeIsNoPoint", "matte flat.obj --eye 1,2 --target 0,0,0 -o out.png", "--eye: '1,2'"},
    {"MatteEyeIsNaN", "matte flat.obj --eye nan,0,0 --target 0,0,0 -o out.png", "--eye"},
    {"MatteLooksAtItsEye", "matte flat.obj --eye 1,2,3 --target 1,2,3 -o out.png", "--target"},
    {"MatteSizeOfWords", "matte flat.obj --eye 1,2,3 --target 0,0,0 --size large -o out.png", "--size: 'large'"},
    {"MatteUnknownMethod", "matte flat.obj --eye 1,2,3 --target 0,0,0 --method best -o out.png", "--method"},
    {"MatteRegionWithoutFile", "matte flat.obj --eye 1,2,3 --target 0,0,0 --method region -o out.png", "--regions"},
    {"MatteRegionsAreText", "matte flat.obj --regions text.mp4 --eye 1,2,3 --target 0,0,0 --method region -o out.png",
     "text.mp4"},
    {"VerifyMissingFile", "verify gone.rgn --mesh flat.obj", "gone.rgn"},
    {"VerifyText", "verify text.mp4 --mesh flat.obj", "text.mp4"},
    {"VerifyNoEyes", "verify text.mp4 --mesh flat.obj --eyes 0", "--eyes"},
    {"ScoreMissingMatte", "score gone.png exists.pdf", "gone.png"},
    {"ScoreText", "score text.mp4 text.mp4", "text.mp4"},
    {"ScoreWithoutTruth", "score text.mp4", "TRUTH"},
    {"CalibrateNoBoardSeen", "calibrate in.mkv --board board.toml -o out.yml", "rinkaku: "},
};

INSTANTIATE_TEST_SUITE_P(All, BadCalls, testing::ValuesIn(calls),
                         [](const testing::TestParamInfo<BadCall>& call) { return call.param.name; });

TEST(Cli, FolderThatMayNotBeWrittenIsNamed) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const BadCallFolder folder;
  fs::permissions(folder / "folder", fs::perms::owner_read | fs::perms::owner_exec);
  for (const char* arguments : {"render good.toml -o folder/out.mkv", "render good.toml -o out.mkv --timings folder/t",
                                "render drawn.toml -o out.mkv --layers folder"}) {
    const test::CliResult got = test::run_rinkaku(folder, arguments);
    EXPECT_EQ(got.status, 2) << arguments;
    EXPECT_TRUE(contains(got.err, "folder")) << got.err;
  }
}

}  // namespace
}  // namespace rinkaku
