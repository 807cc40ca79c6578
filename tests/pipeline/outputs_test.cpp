// What a run may write over, what it leaves in place, and which times it takes.
#include <map>

#include "tests/pipeline/shot_folder.h"

namespace rinkaku::pipeline {
namespace {

namespace fs = std::filesystem;
using test::ShotFolder;

const PictureFormat small = test::picture("yuv420p", 64, 48, test::bt709_limited);

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

// Every file below the folder, but the scene.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().filename() == "scene.toml") continue;
    files[entry.path().string()] = entry.is_regular_file() ? text_of(entry.path()) : "";
  }
  return files;
}

// Renders what must be refused, and checks that nothing was touched; gives the error's line.
std::string refused(const ShotFolder& folder, const std::string& scene, RenderOptions options,
                    Error::Kind kind = Error::Kind::Input) {
  options.overwrite = true;
  const auto before = contents(folder.path());
  const std::string line = test::error_of(kind, [&] { folder.render(scene, options); });
  EXPECT_TRUE(contents(folder.path()) == before) << line;
  return line;
}

// Pictures f/in000.png to f/in003.png.
class PicturesFolder : public ShotFolder {
 public:
  PicturesFolder() {
    fs::create_directory(*this / "f");
    const PictureFormat format = test::picture("rgb24", 64, 48);
    test::write_all({.path = file("f/in%03d.png")}, test::incoming(format), test::noise_frames(format, 4));
  }
};

std::string images(const std::string& pattern, const std::string& more = "") {
  return "[plate]\nimages = \"" + pattern + "\"\n" + more;
}

TEST(OwnInput, PicturesAreNeverWrittenOver) {
  const PicturesFolder folder;
  fs::create_directory_symlink("f", folder / "link");
  fs::create_directory(folder / "g");
  fs::create_symlink("../f/in002.png", folder / "g" / "b2.png");
  for (const char* input : {"f/*.png", "f/in%03d.png", "f/in00?.png", "link/*.png"}) {
    for (const char* output : {"f/in%03d.png", "link/in%03d.png", "f/../link/in%03d.png", "f/in001.png", "g/b%d.png"}) {
      const std::string line = refused(folder, images(input), {.output = output});
      EXPECT_TRUE(contains(line, "is the input itself")) << input << " " << output << ": " << line;
    }
  }
}

TEST(OwnInput, LayersAreNotWrittenOverItEither) {
  const PicturesFolder folder;
  for (int i = 0; i < 4; ++i) {
    const std::string number = std::to_string(i);
    fs::rename(folder / ("f/in00" + number + ".png"), folder / ("f/cg_00000" + number + ".png"));
  }
  const std::string scene = images("f/*.png", "camera = \"camera.yml\"\n" + test::locked + test::cube);
  const std::string line =
      refused(folder, scene, {.output = "out.mkv", .codec = "ffv1", .layers_folder = folder.file("f")});
  EXPECT_TRUE(contains(line, "is the input itself")) << line;
}

TEST(OwnInput, OtherNamesBesideItAreFine) {
  const PicturesFolder folder;
  folder.render(images("f/in*.png"), {.output = "f/out%03d.png"});
  EXPECT_EQ(folder.frames("f/out%03d.png").size(), 4u);
}

TEST(Layers, AndOutputMayNotShareNames) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 3);
  for (const char* output :
       {"d/cg_%06d.png", "e/../d/cg_%06d.png", "d/cg_%d.png", "d/cg_%07d.png", "d/cg_0%05d.png", "d/cg_000000.png"}) {
    const std::string line = refused(folder, test::drawn_scene, {.output = output, .layers_folder = folder.file("d/")});
    EXPECT_TRUE(contains(line, "the layers are to be written under the same names")) << output << ": " << line;
  }
  folder.render(test::drawn_scene, {.output = "d/out_%06d.png", .layers_folder = folder.file("d")});
  EXPECT_EQ(folder.frames("d/out_%06d.png").size(), 3u);
  EXPECT_EQ(folder.frames("d/cg_%06d.png").size(), 3u);
}

// The output's last bytes can't be written; the layers are ready by then.
TEST(Layers, StayAwayIfTheOutputFailsAtItsEnd) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 2);
  fs::create_symlink("/dev/full", folder / "out.mkv");
  const std::string line =
      refused(folder, test::drawn_scene, {.output = "out.mkv", .codec = "ffv1", .layers_folder = folder.file("layers")},
              Error::Kind::Runtime);
  EXPECT_TRUE(contains(line, "No space left on device")) << line;
}

TEST(OutputFolder, OfPicturesIsMade) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 3);
  folder.render(test::plate, {.output = "new/frames/%04d.png"});
  EXPECT_EQ(folder.frames("new/frames/%04d.png").size(), 3u);
}

TEST(OutputFolder, IsTakenAwayAfterAFailure) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 3);
  refused(folder, test::plate, {.output = "new/frames/%04d.png", .first_frame = 7});
}

TEST(PicturesPerSecond, AreTheScenes) {
  const PicturesFolder folder;
  for (const auto& [fps, rate] : {std::pair{"23.976", Rational{24000, 1001}}, {"12.5", Rational{25, 2}}}) {
    folder.render(images("f/*.png", std::string("fps = ") + fps + "\n"),
                  {.output = "out.mp4", .codec = "mpeg4", .overwrite = true});
    const auto out = source::open(folder.file("out.mp4"));
    EXPECT_EQ(out->description().frame_rate, rate) << fps;
    EXPECT_NEAR(test::all_frames(*out)[3].time_s(), 3 / rate.value(), 1e-6) << fps;
  }
}

// Transport streams start at 1.4 s and more; poses at the first picture.
TEST(PosesByTime, CountFromTheVideosFirstFrame) {
  const ShotFolder folder;
  test::ffmpeg("-f lavfi -i testsrc2=s=64x48:r=25 -frames:v 10 -c:v mpeg2video '" + folder.file("in.ts") + "'");
  folder.write("poses.csv",
               "time_s,tx,ty,tz,qx,qy,qz,qw\n0,0,-2,0.25,-0.70710678,0,0,0.70710678\n"
               "0.28,0,-2,0.25,-0.70710678,0,0,0.70710678\n");
  const std::string scene = "[plate]\nvideo = \"in.ts\"\ncamera = \"camera.yml\"\n" + test::poses + test::cube;
  ASSERT_GT(folder.frames("in.ts").front().time_s(), 1);
  RenderReport report = folder.render(scene, {.output = "out.mkv", .codec = "ffv1"});
  EXPECT_EQ(report.posed_frames, 8);  // 0 to 0.28 s
  // A part of the video keeps its times.
  report = folder.render(scene, {.output = "part.mkv", .codec = "ffv1", .first_frame = 5, .end_frame = 10});
  EXPECT_EQ(report.posed_frames, 3);
}

// A phone held upright: stored lying, with the advice to turn it.
TEST(TurnedVideo, SaysWhyTheCameraDoesNotFit) {
  const ShotFolder folder(48, 64);
  sink::Incoming coming = test::incoming(small);
  coming.rotation_deg = 90;
  test::write_all({.path = folder.file("in.mov"), .codec = "mpeg4"}, coming, test::noise_frames(small, 2));
  const std::string line =
      refused(folder, "[plate]\nvideo = \"in.mov\"\ncamera = \"camera.yml\"\n", {.output = "out.mkv", .codec = "ffv1"});
  for (const char* part : {"48x64", "64x48", "players turn it by 90 degrees", "stored picture", "rinkaku calibrate"}) {
    EXPECT_TRUE(contains(line, part)) << line;
  }
}

}  // namespace
}  // namespace rinkaku::pipeline
