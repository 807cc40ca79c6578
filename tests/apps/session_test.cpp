#include <algorithm>
#include <sstream>

#include "tests/apps/cli_tools.h"
#include "tests/apps/fake_camera_tools.h"
#include "tests/support/fake_camera/fake_camera.h"

namespace rinkaku {
namespace {

using namespace test;

std::vector<std::string> frame_hashes(const ShotFolder& folder, const std::string& file) {
  std::istringstream lines(
      shell("ffmpeg -nostdin -v error -i '" + folder.file(file) + "' -map 0:v -vsync passthrough -f framemd5 -"));
  std::vector<std::string> hashes;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("#")) hashes.push_back(line.substr(line.rfind(' ') + 1));
  }
  return hashes;
}

// A recording may have lost frames that its session has, never the other way round, and keeps their order.
void expect_all_in_order(const std::vector<std::string>& shown, const std::vector<std::string>& made) {
  auto at = made.begin();
  for (const std::string& frame : shown) {
    at = std::find(at, made.end(), frame);
    ASSERT_NE(at, made.end());
  }
}

// The scene changes while it is filmed: the cube's colour, from its file.
TEST(Session, RenderMakesTheSameFramesAgainToTheLastBit) {
  NEEDS_PRELOAD();
  const ShotFolder folder(640, 480);
  folder.write("scene.toml", live_scene + "camera = \"camera.yml\"\n" + locked + cube + "colour = \"#ff0000\"\n");
  const CliResult live =
      run_shell(folder.path(), preloaded("FAKE_CAMERA_FPS=20") +
                                   " \"$RINKAKU\" live scene.toml --headless --seconds 4 --record live.mkv --codec "
                                   "ffvhuff --session take --json "
                                   "& player=$!; for i in $(seq 100); do [ $(wc -l <take/session.jsonl) -gt 10 ] "
                                   "2>/dev/null && break; sleep 0.1; "
                                   "done; sed 's/#ff0000/#0000ff/' scene.toml >new && mv new scene.toml; wait $player");
  ASSERT_EQ(live.status, 0) << live.err;
  EXPECT_TRUE(contains(text_of(folder / "take/session.jsonl"), "from_frame"));
  const CliResult again = run_rinkaku(folder, "render take -o again.mkv --codec ffvhuff --json");
  ASSERT_EQ(again.status, 0) << again.err;
  const auto shown = frame_hashes(folder, "live.mkv"), made = frame_hashes(folder, "again.mkv");
  ASSERT_GT(shown.size(), 10u);
  EXPECT_EQ(json_of(again.out)["frames"], made.size());
  ASSERT_NO_FATAL_FAILURE(expect_all_in_order(shown, made));
  // Both colours are there, so the change is.
  const auto frames = folder.frames("again.mkv");
  EXPECT_NE(sample(frames.front(), 2, 160, 240), sample(frames.back(), 2, 160, 240));
}

// The water's colour and arrows change while it is filmed, with its strokes under way.
TEST(Session, WaterThatChangesIsMadeAgainToTheLastBit) {
  NEEDS_PRELOAD();
  const ShotFolder folder(640, 480);
  folder.write("scene.toml",
               live_scene + "camera = \"camera.yml\"\n" + locked +
                   "[water]\nstrokes = 200\ncolour = \"#600000\"\nmirror = { plate = false, reflection = 0 }\n"
                   "[[water.surface]]\noutline_m = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]\n"
                   "[[water.surface.arrow]]\nfrom_m = [0, 0, 0]\nto_m = [0.3, 0, 0]\n");
  const CliResult live =
      run_shell(folder.path(), preloaded("FAKE_CAMERA_FPS=20") +
                                   " \"$RINKAKU\" live scene.toml --headless --seconds 5 --record live.mkv --codec "
                                   "ffvhuff --session take --json "
                                   "& player=$!; for i in $(seq 100); do [ $(wc -l <take/session.jsonl) -gt 10 ] "
                                   "2>/dev/null && break; sleep 0.1; "
                                   "done; sed 's/#600000/#000060/; s/0.3, 0, 0/0, 0.3, 0/' scene.toml >new && mv new "
                                   "scene.toml; wait $player");
  ASSERT_EQ(live.status, 0) << live.err;
  EXPECT_TRUE(contains(text_of(folder / "take/session.jsonl"), "from_frame"));
  const CliResult again = run_rinkaku(folder, "render take -o again.mkv --codec ffvhuff");
  ASSERT_EQ(again.status, 0) << again.err;
  const auto shown = frame_hashes(folder, "live.mkv"), made = frame_hashes(folder, "again.mkv");
  ASSERT_GT(shown.size(), 10u);
  ASSERT_NO_FATAL_FAILURE(expect_all_in_order(shown, made));
  // Red water first, then blue: V falls and U rises in the middle of it.
  const auto frames = folder.frames("again.mkv");
  EXPECT_GT(sample(frames.front(), 2, 160, 300), sample(frames.back(), 2, 160, 300) + 20);
  EXPECT_LT(sample(frames.front(), 1, 160, 300), sample(frames.back(), 1, 160, 300) - 20);
}

// Poses that were predicted are in the session like any others.
TEST(Session, OfLowestLatencyIsMadeAgainAsWell) {
  NEEDS_PRELOAD();
  const ShotFolder folder(640, 480);
  folder.write("scene.toml", live_scene + "camera = \"camera.yml\"\n" + locked + cube + "colour = \"#ff0000\"\n");
  const CliResult live =
      run_shell(folder.path(), preloaded("FAKE_CAMERA_FPS=20") +
                                   " \"$RINKAKU\" live scene.toml --headless --lowest-latency --seconds 2 --record "
                                   "live.mkv --codec ffvhuff --session take");
  ASSERT_EQ(live.status, 0) << live.err;
  ASSERT_EQ(run_rinkaku(folder, "render take -o again.mkv --codec ffvhuff").status, 0);
  const auto shown = frame_hashes(folder, "live.mkv"), made = frame_hashes(folder, "again.mkv");
  ASSERT_GT(shown.size(), 5u);
  ASSERT_NO_FATAL_FAILURE(expect_all_in_order(shown, made));
  // Before the tracker's first answer nothing is drawn, at the end the red cube is.
  EXPECT_GT(sample(folder.frames("live.mkv").back(), 2, 160, 240), 170);
}

TEST(Session, RecordingIsPlayableWhenItIsKilled) {
  NEEDS_PRELOAD();
  for (const std::string file : {"out.mp4", "out.mkv"}) {
    const ShotFolder folder;
    folder.write("scene.toml", live_scene);
    const CliResult live =
        run_shell(folder.path(), preloaded("") + " \"$RINKAKU\" live scene.toml --headless --record " + file +
                                     " & player=$!; for i in $(seq 100); do [ -s " + file +
                                     " ] && break; sleep 0.1; done; "
                                     "date +%s.%N >start; sleep 2.5; kill -9 $player; wait $player; true");
    ASSERT_EQ(live.status, 0) << live.err;
    const auto times = frame_hashes(folder, file);
    // 30 frames a second for 2.5 s, of which the last second may be missing; half of it for a busy machine.
    EXPECT_GT(times.size(), 22u) << file;
  }
}

TEST(Session, BadSessionsAreNamed) {
  const ShotFolder folder;
  std::filesystem::create_directories(folder / "take");
  folder.write("take/session.jsonl", "{\"session\":1,\"scene\":\"s.toml\",\"text\":\"x\"}\n{\"frame\":0}\n");
  const CliResult bad = run_rinkaku(folder, "render take -o out.mkv");
  EXPECT_EQ(bad.status, 2);
  EXPECT_EQ(bad.err,
            "rinkaku: take/session.jsonl:2: is no line of a session's log; take the session as it was written\n");
  folder.write("take/session.jsonl", "{\"session\":1,\"scene\":\"s.toml\",\"text\":\"x\"}\n{\"fra");
  const CliResult empty = run_rinkaku(folder, "render take -o out.mkv");
  EXPECT_EQ(empty.status, 2);
  EXPECT_EQ(empty.err, "rinkaku: take/session.jsonl: the session holds no frame\n");
}

// The device is a file that the preloaded library answers for.
TEST(Session, VirtualCameraGetsTheFramesAsYuyv) {
  NEEDS_PRELOAD();
  const ShotFolder folder;
  folder.write("scene.toml", live_scene);
  folder.write("output", "");
  const CliResult live = run_shell(
      folder.path(), preloaded("FAKE_OUTPUT=\"$PWD/output\"") +
                         " \"$RINKAKU\" live scene.toml --headless --seconds 1 --virtual-camera \"$PWD/output\" "
                         "--record out.mkv --codec ffv1 --json");
  ASSERT_EQ(live.status, 0) << live.err;
  const std::string written = text_of(folder / "output");
  constexpr std::size_t bytes = 640 * 480 * 2;
  EXPECT_EQ(written.size() % bytes, 0u);
  ASSERT_GE(written.size(), bytes);
  // The first frame as the recording has it, in YUYV's order.
  const Frame frame = folder.frames("out.mkv").at(0);
  for (int y = 0; y < 480; y += 37) {
    for (int x = 0; x < 640; x += 2) {
      const std::size_t at = static_cast<std::size_t>(y) * 1280 + static_cast<std::size_t>(x) * 2;
      const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(written[at + i]); };
      ASSERT_EQ(byte(0), sample(frame, 0, x, y));
      ASSERT_EQ(byte(1), sample(frame, 1, x / 2, y));
      ASSERT_EQ(byte(2), sample(frame, 0, x + 1, y));
      ASSERT_EQ(byte(3), sample(frame, 2, x / 2, y));
    }
  }
  const CliResult none = run_rinkaku(folder, "live scene.toml --camera /dev/null --virtual-camera /dev/null");
  EXPECT_EQ(none.status, 2);
}

// A PipeWire of its own, and GStreamer to read it.
TEST(Session, AnotherProgramReadsTheCameraInPipewire) {
  NEEDS_PRELOAD();
  if (std::system("command -v pipewire wireplumber dbus-run-session gst-launch-1.0 >/dev/null 2>&1") != 0 ||
      std::system("gst-inspect-1.0 pipewiresrc >/dev/null 2>&1") != 0) {
    GTEST_SKIP() << "PipeWire, WirePlumber, D-Bus or GStreamer's pipewiresrc is not installed";
  }
  const ShotFolder folder;
  folder.write("scene.toml", live_scene);
  folder.write("inside",
               "export XDG_RUNTIME_DIR=$PWD\n"
               "pipewire >pipewire.log 2>&1 & server=$!\n"
               "for i in $(seq 100); do [ -S pipewire-0 ] && break; sleep 0.1; done\n"
               "wireplumber >wireplumber.log 2>&1 & manager=$!\n" +
                   preloaded("") +
                   " \"$RINKAKU\" live scene.toml --headless --seconds 15 --virtual-camera pipewire & "
                   "player=$!\n"
                   "for i in $(seq 100); do pw-cli ls Node 2>/dev/null | grep -q Video/Source && break; sleep 0.1; "
                   "done\n"
                   "timeout 12 gst-launch-1.0 -q pipewiresrc target-object=rinkaku num-buffers=3 ! "
                   "video/x-raw,format=YUY2 ! filesink location=read.yuv\n"
                   "wait $player; status=$?; kill $manager $server; exit $status\n");
  const CliResult result = run_shell(folder.path(), "export RINKAKU; timeout 60 dbus-run-session bash ./inside");
  ASSERT_EQ(result.status, 0) << result.err;
  const std::string read = text_of(folder / "read.yuv");
  constexpr std::size_t bytes = 640 * 480 * 2;
  ASSERT_EQ(read.size(), 3 * bytes);
  // The fake camera's pictures differ by one value in all samples: what was read is one of them, bit by bit.
  const auto sample_at = [&read](std::size_t i) { return static_cast<std::uint8_t>(read[2 * bytes + i]); };
  const int shift = sample_at(0) - fake_sample(0, 0);
  for (std::size_t i = 0; i < bytes; ++i) {
    ASSERT_EQ(sample_at(i), static_cast<std::uint8_t>(fake_sample(0, i) + shift)) << i;
  }
}

}  // namespace
}  // namespace rinkaku
