#include <csignal>
#include <cstdlib>

#include "tests/apps/cli_tools.h"
#include "tests/apps/fake_camera_tools.h"

namespace rinkaku {
namespace {

using namespace test;

constexpr const char* camera = fake_camera_path;

CliResult with_camera(const ShotFolder& folder, const std::string& settings, const std::string& arguments) {
  return run_shell(folder.path(), preloaded(settings) + " \"$RINKAKU\" " + arguments);
}

TEST(Live, DevicesListsModesAndControls) {
  NEEDS_PRELOAD();
  const ShotFolder folder;
  const auto all =
      json_of(with_camera(folder, "FAKE_CAMERA_FORMATS=YUYV,BA81", "devices --json " + std::string(camera)).out);
  ASSERT_EQ(all["cameras"].size(), 1u);
  const auto& one = all["cameras"][0];
  EXPECT_EQ(one["name"], "Fake Camera");
  EXPECT_EQ(one["modes"].size(), 4u);
  EXPECT_EQ(one["modes"][0]["width"], 640);
  EXPECT_EQ(one["modes"][0]["fps"][0], 30.0);
  EXPECT_EQ(one["modes"][0]["readable"], true);
  EXPECT_EQ(one["modes"][2]["format"], "BA81");
  EXPECT_EQ(one["modes"][2]["readable"], false);
  EXPECT_EQ(one["controls"][0]["name"], "brightness");
}

TEST(Live, RendersACameraUntilToldToStop) {
  NEEDS_PRELOAD();
  const ShotFolder folder;
  folder.write("scene.toml", live_scene);
  const CliResult result =
      with_camera(folder, "FAKE_CAMERA_FPS=50", "render scene.toml --frames :20 -o out.mkv --codec ffv1 --json");
  ASSERT_EQ(result.status, 0) << result.err;
  const auto report = json_of(result.out);
  const auto frames = folder.frames("out.mkv");
  EXPECT_EQ(report["frames"], frames.size());
  EXPECT_EQ(report["frames"].get<int>() + report["dropped"].get<int>(), 20);
  EXPECT_EQ(frames.at(0).format.width_px, 640);
}

TEST(Live, RunsWithoutAWindowAndRecordsWhatItShows) {
  NEEDS_PRELOAD();
  const ShotFolder folder(640, 480);
  folder.write("scene.toml", live_scene + "camera = \"camera.yml\"\n" + locked + cube);
  const CliResult result =
      with_camera(folder, "", "live scene.toml --headless --seconds 1.5 --record out.mkv --codec ffvhuff --json");
  ASSERT_EQ(result.status, 0) << result.err;
  const auto report = json_of(result.out);
  EXPECT_GT(report["frames"].get<int>(), 5);  // of 45; this machine may be busy
  const auto frames = folder.frames("out.mkv");
  EXPECT_GE(frames.size(), report["frames"].get<std::size_t>());
  // The cube covers the middle: its colour is one, where the fake camera's picture is noise.
  EXPECT_EQ(sample(frames.back(), 0, 320, 240), sample(frames.back(), 0, 322, 240));
}

TEST(Live, BadCallsAreOneLine) {
  const ShotFolder folder;
  folder.write("scene.toml", live_scene);
  folder.noise_clip("in.mkv", picture("yuv420p", 64, 48), 2);
  folder.write("film.toml", "[plate]\nvideo = \"in.mkv\"\n");
  const auto expect = [&](const std::string& arguments, const std::string& line) {
    const CliResult result = run_rinkaku(folder, arguments);
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_EQ(result.err, "rinkaku: " + line + "\n");
    EXPECT_EQ(result.out, "");
  };
  expect("live film.toml", folder.file("film.toml") +
                               ": films a recording, not a camera; give --camera /dev/video0, or 'device' in [plate]; "
                               "'rinkaku play' shows recordings");
  expect("play scene.toml", folder.file("scene.toml") + ": films with a camera; show it with 'rinkaku live'");
  expect("live scene.toml",
         std::string(camera) + ": there is no such camera; 'rinkaku devices' lists the cameras there are");
  expect("live film.toml --camera /dev/null",
         "/dev/null: is no video device; 'rinkaku devices' lists the cameras there are");
}

TEST(Live, WithoutADisplayItSaysSo) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", picture("yuv420p", 64, 48), 2);
  folder.write("scene.toml", "[plate]\nvideo = \"in.mkv\"\n");
  const CliResult result = run_shell(folder.path(), "env -u DISPLAY -u WAYLAND_DISPLAY \"$RINKAKU\" play scene.toml");
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.err, "rinkaku: window: can't be opened")) << result.err;
  EXPECT_TRUE(contains(result.err, "'rinkaku render' needs no display")) << result.err;
}

// A screen of its own for what `line` runs; the keys are sent by xdotool, the picture taken by ffmpeg.
CliResult on_a_screen(const ShotFolder& folder, const std::string& line) {
  return run_shell(
      folder.path(),
      "exec 3>display; Xvfb -displayfd 3 -screen 0 320x240x24 -nolisten tcp & screen=$!; "
      "for i in $(seq 100); do [ -s display ] && break; sleep 0.1; done; export DISPLAY=:$(cat display); " +
          line + "; status=$?; kill $screen; wait $screen; exit $status");
}

// Plays scene.toml on such a screen; `keys` is run once the window is there, which is then closed.
CliResult play_on_a_screen(const ShotFolder& folder, const std::string& options, const std::string& keys) {
  return on_a_screen(
      folder, "\"$RINKAKU\" play scene.toml " + options +
                  " --no-panel --json >report 2>trouble & player=$!; for i in $(seq 100); do xdotool search --name "
                  "rinkaku >window 2>/dev/null && break; sleep 0.1; done; sleep 1.5; " +
                  keys + "xdotool key q; wait $player");
}

// Takes the $n-th screenshot, and waits for it.
const std::string screenshot =
    "xdotool mousemove 32 24 key p; for k in $(seq 100); do [ -s rinkaku_00000$n.png ] && break; sleep 0.1; done; ";

Frame shot(const ShotFolder& folder, int number) {
  return folder.frames("rinkaku_00000" + std::to_string(number) + ".png").at(0);
}

void write_cube_on_grey(const ShotFolder& folder) {
  test::ffmpeg("-f lavfi -i color=gray:size=640x480:rate=25 -frames:v 4 -pix_fmt yuv420p -c:v ffv1 '" +
               folder.file("in.mkv") + "'");
  folder.write("scene.toml", "[plate]\nvideo = \"in.mkv\"\ncamera = \"camera.yml\"\n" + locked + cube);
}

TEST(Live, WindowShowsTheCompositeAndObeysKeys) {
  if (std::system("command -v Xvfb xdotool >/dev/null 2>&1") != 0) GTEST_SKIP() << "Xvfb or xdotool is not installed";
  const ShotFolder folder;
  // One colour, so that a screen's pixel tells it whatever the scale: Y'CbCr (120, 100, 180), BT.601.
  test::ffmpeg(
      "-f lavfi -i color=gray:size=64x48:rate=25 -frames:v 50 -vf "
      "\"geq=lum=120:cb=100:cr=180,setparams=colorspace=smpte170m:range=tv\" -pix_fmt yuv420p -c:v ffv1 '" +
      folder.file("in.mkv") + "'");
  folder.write("scene.toml", "[plate]\nvideo = \"in.mkv\"\n");
  const CliResult result =
      play_on_a_screen(folder, "",
                       "ffmpeg -nostdin -v error -y -f x11grab -video_size 320x240 -i $DISPLAY -frames:v 1 screen.png; "
                       "xdotool mousemove 32 24 key p; sleep 0.7; xdotool key f; sleep 0.7; "
                       "ffmpeg -nostdin -v error -y -f x11grab -video_size 320x240 -i $DISPLAY -frames:v 1 full.png; ");
  ASSERT_EQ(result.status, 0) << result.err << text_of(folder / "trouble");
  const auto report = json_of(text_of(folder / "report"));
  EXPECT_GT(report["frames"].get<int>(), 5);
  // R = 1.164 (Y - 16) + 1.596 (V - 128), G and B likewise.
  const auto colour_at = [&folder](const std::string& file, int x, int y) {
    const Frame frame = folder.frames(file).at(0);
    return std::array{sample(frame, 0, x, y), sample(frame, 1, x, y), sample(frame, 2, x, y)};
  };
  const auto screen = colour_at("screen.png", 32, 24), full = colour_at("full.png", 160, 120);
  const std::array expected{204, 90, 65};
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(screen[c], expected[c], 3) << c;  // rounding of three codes
    EXPECT_NEAR(full[c], expected[c], 3) << c;
  }
  // The screenshot is the picture itself.
  EXPECT_TRUE(std::filesystem::exists(folder / "rinkaku_000001.png"));
  EXPECT_EQ(folder.frames("rinkaku_000001.png").at(0).format.width_px, 64);
}

TEST(Live, KeyShowsMattesAndCurvature) {
  if (std::system("command -v Xvfb xdotool >/dev/null 2>&1") != 0) GTEST_SKIP() << "Xvfb or xdotool is not installed";
  const ShotFolder folder(640, 480);
  write_cube_on_grey(folder);
  const CliResult result =
      play_on_a_screen(folder, "", "for n in 1 2 3; do " + screenshot + "xdotool key v; sleep 2; done; ");
  ASSERT_EQ(result.status, 0) << result.err << text_of(folder / "trouble");
  const Frame picture = shot(folder, 1), mattes = shot(folder, 2), curvature = shot(folder, 3);
  // The cube is in the middle and leaves the corners free.
  EXPECT_EQ(mattes.format.pixels.model, ColourModel::Grey);
  EXPECT_EQ(sample(mattes, 0, 320, 240), 255);
  EXPECT_EQ(sample(mattes, 0, 2, 2), 0);
  // All of a cube's corners are convex, which is red; before it had its own colour.
  EXPECT_GT(sample(curvature, 0, 320, 240), sample(curvature, 2, 320, 240) + 30);
  EXPECT_NE(sample(curvature, 1, 320, 240), sample(picture, 1, 320, 240));
  for (int c = 0; c < 3; ++c) EXPECT_EQ(sample(curvature, c, 2, 2), sample(picture, c, 2, 2));
}

TEST(Live, FlowArrowsAreDrawnWithTheMouseAndSaved) {
  if (std::system("command -v Xvfb xdotool >/dev/null 2>&1") != 0) GTEST_SKIP() << "Xvfb or xdotool is not installed";
  const ShotFolder folder(640, 480);
  test::ffmpeg("-f lavfi -i color=gray:size=640x480:rate=25 -frames:v 4 -pix_fmt yuv420p -c:v ffv1 '" +
               folder.file("in.mkv") + "'");
  const std::string scene = plate +
                            "[track]\nlocked = { position_m = [0, 0, 3], look_at_m = [0, 0, 0], up = [0, 1, 0] }\n"
                            "[water] # a pond\nstrokes = 200\n"
                            "[[water.surface]]\noutline_m = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]\n";
  folder.write("scene.toml", scene);
  // The window is half as large as the picture. Its (160, 120) is the middle of the picture and sees the world's
  // origin; 50 pixels there are 100 of the picture, 100 x 3 / 640 m on the water.
  const CliResult result = play_on_a_screen(
      folder, "",
      "xdotool mousemove 160 120 key a; sleep 1; xdotool mousedown 1; sleep 0.5; xdotool mousemove 180 "
      "120; sleep 0.5; xdotool mousemove 210 120; sleep 0.5; xdotool mouseup 1; sleep 2; xdotool key "
      "ctrl+s; sleep 1; ");
  ASSERT_EQ(result.status, 0) << result.err << text_of(folder / "trouble");
  const std::string saved = text_of(folder / "scene.toml");
  ASSERT_TRUE(saved.starts_with(scene)) << saved;
  EXPECT_EQ(saved.substr(scene.size() - 1), "\n[[water.surface.arrow]]\nfrom_m = [0, 0, 0]\nto_m = [0.469, 0, 0]\n");
}

TEST(Live, ShadersAreReadAnewAndWrongOnesChangeNothing) {
  if (std::system("command -v Xvfb xdotool >/dev/null 2>&1") != 0) GTEST_SKIP() << "Xvfb or xdotool is not installed";
  const ShotFolder folder(640, 480);
  write_cube_on_grey(folder);
  const auto shader = [](const char* colour) {
    return std::string("layout(location = 0) out vec4 fragment; void main() { fragment = vec4(") + colour + ", 1); }";
  };
  std::filesystem::create_directories(folder.path() / "s/pipeline/passes/toon");
  folder.write("s/pipeline/passes/toon/toon.frag", shader("0, 1, 0"));
  folder.write("blue.frag", shader("0, 0, 1"));
  folder.write("wrong.frag", "void main() { this is no shader }");
  const CliResult result = play_on_a_screen(
      folder, "--shaders s",
      "n=1; " + screenshot + "for next in blue wrong; do cp $next.frag new; mv new s/pipeline/passes/toon/toon.frag; " +
          "sleep 3; n=$((n + 1)); " + screenshot + "done; ");
  ASSERT_EQ(result.status, 0) << result.err << text_of(folder / "trouble");
  const auto middle = [&folder](int number) {
    const Frame frame = shot(folder, number);
    return std::array{sample(frame, 0, 320, 240), sample(frame, 1, 320, 240), sample(frame, 2, 320, 240)};
  };
  const auto green = middle(1), blue = middle(2), after_wrong = middle(3);
  EXPECT_GT(green[1], 200);
  EXPECT_LT(green[2], 60);
  EXPECT_GT(blue[2], 200);
  EXPECT_LT(blue[1], 60);
  EXPECT_EQ(after_wrong, blue);
}

}  // namespace
}  // namespace rinkaku
