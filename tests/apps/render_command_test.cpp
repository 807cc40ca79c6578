// `rinkaku render` as a user calls it.
#include <csignal>
#include <thread>

#include "tests/apps/cli_tools.h"

namespace rinkaku {
namespace {

namespace fs = std::filesystem;
using test::contains;

const PictureFormat small = test::picture("yuv420p", 64, 48, test::bt709_limited);

class RenderFolder : public test::ShotFolder {
 public:
  explicit RenderFolder(int frames = 12) {
    noise_clip("in.mkv", small, frames);
    write("scene.toml", test::drawn_scene + "outline = true\n");
    write("empty.toml", test::plate);
  }
};

void expect_report(const nlohmann::json& report, int frames, const std::vector<std::string>& stages) {
  EXPECT_EQ(report.at("frames"), frames);
  EXPECT_EQ(report.at("width"), 64);
  EXPECT_EQ(report.at("height"), 48);
  EXPECT_GT(report.at("fps"), 0);
  std::vector<std::string> names;
  for (const auto& stage : report.at("stages")) {
    names.push_back(stage.at("name"));
    EXPECT_GT(stage.at("p50_ms"), 0);
    EXPECT_LE(stage.at("p50_ms"), stage.at("p99_ms"));
    EXPECT_LE(stage.at("p99_ms"), stage.at("max_ms"));
  }
  EXPECT_EQ(names, stages);
}

const std::vector<std::string> drawn_stages{"decode", "track", "draw", "composite", "encode"};

TEST(RenderCommand, JsonTellsFramesSizeSpeedAndStages) {
  const RenderFolder folder;
  const test::CliResult got = test::run_rinkaku(folder, "render scene.toml -o out.mkv --codec ffv1 --json");
  EXPECT_EQ(got.status, 0);
  EXPECT_EQ(got.err, "");
  expect_report(test::json_of(got.out), 12, drawn_stages);
  EXPECT_EQ(folder.frames("out.mkv").size(), 12u);
}

TEST(RenderCommand, JsonTellsWhatWasMadeOfOpenGl) {
  const RenderFolder folder;
  const auto made = [&folder](const char* scene) {
    const auto got = test::run_rinkaku(folder, std::string("render ") + scene + " -o made.mkv --force --json");
    EXPECT_EQ(got.status, 0) << got.err;
    return test::json_of(got.out).at("opengl");
  };
  EXPECT_EQ(made("empty.toml"), nlohmann::json({{"programs", 0}, {"buffers", 0}, {"textures", 0}}));
  const nlohmann::json drawn = made("scene.toml");
  EXPECT_GE(drawn.at("programs"), 2);  // shading and line
  EXPECT_GE(drawn.at("buffers"), 2);   // vertices and indices
}

TEST(RenderCommand, SkinningOnTheGpuIsAShaderMore) {
  RINKAKU_NEEDS_DATA();
  const RenderFolder folder;
  const auto programs = [&folder](const std::string& skinning) {
    folder.write("fox.toml", test::plate + test::locked + "[[object]]\nmesh = \"" +
                                 test::data("meshes/animated/Fox.glb").string() +
                                 "\"\nheight_m = 1\nanimation = { skinning = \"" + skinning + "\" }\n");
    const auto got = test::run_rinkaku(folder, "render fox.toml -o fox.mkv --codec ffv1 --force --json");
    EXPECT_EQ(got.status, 0) << got.err;
    return test::json_of(got.out).at("opengl").at("programs").get<int>();
  };
  EXPECT_EQ(programs("gpu"), programs("cpu") + 1);
}

TEST(RenderCommand, TimingsTellTheSameInAFile) {
  const RenderFolder folder;
  const test::CliResult got =
      test::run_rinkaku(folder, "render scene.toml -o out.mkv --codec ffv1 --json --timings t.json");
  ASSERT_EQ(got.status, 0) << got.err;
  const auto written = nlohmann::json::parse(test::text_of(folder / "t.json"));
  expect_report(written, 12, drawn_stages);
  EXPECT_EQ(written, test::json_of(got.out));
}

TEST(RenderCommand, TakesEveryDocumentedOptionInAnyOrder) {
  const RenderFolder folder;
  folder.noise_clip("other.mkv", small, 8);
  const test::CliResult got = test::run_rinkaku(
      folder,
      "render --frames 2:7 --layers layers --timings t.json -o out.mkv --input other.mkv --codec ffvhuff scene.toml");
  ASSERT_EQ(got.status, 0) << got.err;
  EXPECT_TRUE(contains(got.out, "out.mkv: 5 frames of 64x48")) << got.out;
  EXPECT_EQ(folder.frames("out.mkv").size(), 5u);
  EXPECT_EQ(folder.frames("layers/cg_%06d.png").size(), 5u);
  EXPECT_TRUE(fs::exists(folder / "t.json"));
}

TEST(RenderCommand, OpenRangesOfFramesReachTheEnds) {
  const RenderFolder folder;
  for (const auto& [range, frames] : {std::pair{"10:", 2}, {":3", 3}, {":", 12}}) {
    const test::CliResult got = test::run_rinkaku(
        folder, std::string("render empty.toml -o out.mkv --codec ffv1 --json --force --frames ") + range);
    ASSERT_EQ(got.status, 0) << got.err;
    EXPECT_EQ(test::json_of(got.out).at("frames"), frames) << range;
  }
}

TEST(RenderCommand, OutputOfTheSceneFileLiesBesideIt) {
  const RenderFolder folder;
  folder.write("own.toml", test::plate + "[output]\nvideo = \"own.mkv\"\ncodec = \"ffv1\"\n");
  const test::CliResult got = test::run_shell("/", "\"$RINKAKU\" render '" + folder.file("own.toml") + "'");
  EXPECT_EQ(got.status, 0) << got.err;
  EXPECT_EQ(folder.frames("own.mkv").size(), 12u);
}

TEST(RenderCommand, ForceWritesOver) {
  const RenderFolder folder;
  folder.write("out.mkv", "old");
  EXPECT_EQ(test::run_rinkaku(folder, "render empty.toml -o out.mkv --codec ffv1").status, 2);
  EXPECT_EQ(test::text_of(folder / "out.mkv"), "old");
  EXPECT_EQ(test::run_rinkaku(folder, "render empty.toml -o out.mkv --codec ffv1 --force").status, 0);
  EXPECT_EQ(folder.frames("out.mkv").size(), 12u);
}

TEST(RenderCommand, PipeOfY4mIsReadByFfmpeg) {
  const RenderFolder folder;
  const test::CliResult got = test::run_shell(
      folder.path(), "\"$RINKAKU\" render empty.toml -o - --format y4m | ffmpeg -v error -i - -f rawvideo -");
  EXPECT_TRUE(got.out == test::decoded_by_ffmpeg(folder.file("in.mkv"))) << got.err;
  EXPECT_GT(got.out.size(), 12u * 64 * 48);
  EXPECT_TRUE(contains(got.err, "12 frames")) << got.err;  // the summary keeps out of the pictures' way
}

TEST(RenderCommand, PipeThatTheSceneNamesCarriesPicturesOnly) {
  const RenderFolder folder;
  folder.write("pipe.toml", test::plate + "[output]\nvideo = \"-\"\n");
  const test::CliResult got = test::run_rinkaku(folder, "render pipe.toml --format raw");
  EXPECT_EQ(got.status, 0);
  EXPECT_TRUE(got.out == test::decoded_by_ffmpeg(folder.file("in.mkv"))) << got.err;
}

TEST(RenderCommand, PipeThatClosesEarlyIsAnErrorAtRunTime) {
  const RenderFolder folder(400);
  const test::CliResult got = test::run_shell(
      folder.path(),
      "{ \"$RINKAKU\" render empty.toml -o - --format y4m; echo \"status $?\" >&2; } | head -c 100 >/dev/null");
  EXPECT_TRUE(contains(got.err, "rinkaku: standard output: can't be written")) << got.err;
  EXPECT_TRUE(contains(got.err, "status 1\n")) << got.err;
}

TEST(RenderCommand, DamageIsANoteAndNoFailure) {
  const RenderFolder folder(30);
  fs::resize_file(folder / "in.mkv", fs::file_size(folder / "in.mkv") / 2);
  const test::CliResult got = test::run_rinkaku(folder, "render empty.toml -o out.mkv --codec ffv1 --json");
  EXPECT_EQ(got.status, 0);
  EXPECT_EQ(got.err.rfind("rinkaku: note: ", 0), 0u) << got.err;
  const auto report = test::json_of(got.out);
  EXPECT_EQ(report.at("frames"), folder.frames("out.mkv").size());
  EXPECT_FALSE(report.at("notices").empty());
}

TEST(RenderCommand, FullDiskIsOneLineAndStatus1AndLeavesNothing) {
  const RenderFolder folder(60);
  const auto before = test::contents(folder.path());
  // ulimit counts blocks of 512 or 1024 bytes: 20 or 40 kB, a tenth of what this takes.
  const test::CliResult got =
      test::run_shell(folder.path(), "ulimit -f 40; \"$RINKAKU\" render empty.toml -o out.mkv --codec ffv1");
  EXPECT_EQ(got.status, 1);
  EXPECT_EQ(got.out, "");
  EXPECT_EQ(std::count(got.err.begin(), got.err.end(), '\n'), 1) << got.err;
  EXPECT_EQ(got.err.rfind("rinkaku: out.mkv: can't be written", 0), 0u) << got.err;
  EXPECT_TRUE(test::contents(folder.path()) == before);
}

// The pictures' folder takes the name before the times are written.
TEST(RenderCommand, TimingsThatCanNotBePutInPlaceAreAnError) {
  const RenderFolder folder;
  const test::CliResult got = test::run_rinkaku(folder, "render empty.toml -o t/%04d.png --timings t");
  EXPECT_EQ(got.status, 1);
  EXPECT_EQ(got.err.rfind("rinkaku: t: can't be put in place", 0), 0u) << got.err;
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    EXPECT_FALSE(entry.path().filename().string().starts_with(".t.")) << entry.path();
  }
}

TEST(RenderCommand, FullStandardOutputIsNotPassedOver) {
  const RenderFolder folder;
  const test::CliResult got = test::run_shell(folder.path(), "\"$RINKAKU\" explain scene.toml --json >/dev/full");
  EXPECT_EQ(got.status, 1);
  EXPECT_EQ(got.err.rfind("rinkaku: standard output", 0), 0u) << got.err;
}

// The first Ctrl-C ends the video where it is.
class Interrupts : public testing::TestWithParam<const char*> {};

TEST_P(Interrupts, LeaveAWholeVideo) {
  const RenderFolder folder;
  test::ffmpeg("-f lavfi -i testsrc2=s=64x48:r=25 -frames:v 30000 -pix_fmt yuv420p -c:v rawvideo '" +
               folder.file("long.mkv") + "'");
  const test::CliResult got = test::run_shell(
      folder.path(),
      std::string("\"$RINKAKU\" render scene.toml --input long.mkv -o out.mkv --codec ffv1 --json & job=$!; "
                  // Until frames are written.
                  "for i in $(seq 200); do sleep 0.05; size=$(cat .out.mkv.* 2>/dev/null | wc -c); "
                  "[ \"$size\" -gt 100000 ] && break; done; kill -") +
          GetParam() + " $job; wait $job");
  EXPECT_EQ(got.status, 0) << got.err;
  const auto report = test::json_of(got.out);
  EXPECT_EQ(report.at("interrupted"), true);
  EXPECT_GT(report.at("frames"), 0);
  EXPECT_LT(report.at("frames"), 30000);
  const auto out = source::open(folder.file("out.mkv"));
  EXPECT_EQ(report.at("frames"), test::all_frames(*out).size());
  EXPECT_EQ(out->damage(), "");
}
// A shell without job control starts background jobs with SIGINT ignored; the program installs its handler anyway.
INSTANTIATE_TEST_SUITE_P(Signals, Interrupts, testing::Values("INT", "TERM"));

TEST(RenderCommand, ProgressBarShowsOnATerminalOnly) {
  const RenderFolder folder;
  if (std::system("command -v script >/dev/null 2>&1") != 0) GTEST_SKIP() << "script is not installed";
  const std::string call = "\"$RINKAKU\" render scene.toml -o out.mkv --codec ffv1 --force";
  const test::CliResult plain = test::run_shell(folder.path(), call);
  EXPECT_EQ(plain.err, "");
  const test::CliResult terminal =
      test::run_shell(folder.path(), "export RINKAKU; script -qec '" + call + "' /dev/null");
  EXPECT_TRUE(contains(terminal.out, "/12 frames")) << terminal.out;
}

}  // namespace
}  // namespace rinkaku
