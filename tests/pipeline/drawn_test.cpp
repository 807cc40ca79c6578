// What is drawn, where and when: the whole way of a frame, with CG.
#include <algorithm>
#include <cmath>
#include <set>

#include <unistd.h>

#include "pipeline/gl/context.h"
#include "tests/pipeline/made_by.h"
#include "tests/pipeline/shot_folder.h"

namespace rinkaku::pipeline {
namespace {

using test::ShotFolder;

const PictureFormat small = test::picture("yuv420p", 64, 48, test::bt709_limited);

// Numbers of the frames in which the layer shows anything.
std::set<std::size_t> drawn_frames(const std::vector<Frame>& layers) {
  std::set<std::size_t> drawn;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const PictureFormat& format = layers[i].format;
    for (int y = 0; y < format.height_px; ++y) {
      for (int x = 0; x < format.width_px; ++x) {
        if (test::sample(layers[i], 3, x, y) > 0) drawn.insert(i);
      }
    }
  }
  return drawn;
}

std::set<std::size_t> changed_frames(const std::vector<Frame>& before, const std::vector<Frame>& after) {
  std::set<std::size_t> changed;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (test::samples(after[i]) != test::samples(before[i])) changed.insert(i);
  }
  return changed;
}

// The camera a metre and a half away, looking along the world's y at the cube.
std::string pose_line(int frame) { return std::to_string(frame) + ",0,-1.5,0.25,-0.70710678,0,0,0.70710678\n"; }

std::string pose_text(const std::vector<int>& frames) {
  std::string text = "frame,tx,ty,tz,qx,qy,qz,qw\n";
  for (const int frame : frames) text += pose_line(frame);
  return text;
}

TEST(Drawn, TwoRendersAreIdentical) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 12);
  const std::string scene = test::drawn_scene + "outline = true\n";
  folder.render(scene, {.output = "a.mkv", .codec = "ffv1"});
  folder.render(scene, {.output = "b.mkv", .codec = "ffv1"});
  const auto a = folder.frames("a.mkv"), b = folder.frames("b.mkv");
  ASSERT_EQ(a.size(), 12u);
  EXPECT_EQ(changed_frames(folder.frames("in.mkv"), a).size(), 12u);
  EXPECT_EQ(changed_frames(a, b), std::set<std::size_t>());
}

TEST(Drawn, CgIsAbsentWhereThePoseFileHasNoPose) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 12);
  folder.write("poses.csv", pose_text({2, 3, 7, 11, 40}));
  const RenderReport report =
      folder.render(test::plate + test::poses + test::cube, {.output = "out.mkv", .codec = "ffv1"});
  EXPECT_EQ(report.frames, 12);
  EXPECT_EQ(report.posed_frames, 4);
  EXPECT_EQ(changed_frames(folder.frames("in.mkv"), folder.frames("out.mkv")), (std::set<std::size_t>{2, 3, 7, 11}));
}

// Frame-locked: a part of the video meets the poses of its own frames.
TEST(Drawn, PartOfTheFramesKeepsTheirNumbers) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 12);
  folder.write("poses.csv", pose_text({5, 8}));
  const RenderReport report = folder.render(test::plate + test::poses + test::cube,
                                            {.output = "out.mkv", .codec = "ffv1", .first_frame = 4, .end_frame = 9});
  EXPECT_EQ(report.frames, 5);
  EXPECT_EQ(report.posed_frames, 2);
  auto in = folder.frames("in.mkv");
  const auto out = folder.frames("out.mkv");
  ASSERT_EQ(out.size(), 5u);
  in.erase(in.begin(), in.begin() + 4);
  EXPECT_EQ(changed_frames(in, out), (std::set<std::size_t>{1, 4}));
}

TEST(Drawn, FramesPastTheEndAreTheVideosEnd) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 12);
  const RenderReport report =
      folder.render(test::plate, {.output = "out.mkv", .codec = "ffv1", .first_frame = 9, .end_frame = 1000});
  EXPECT_EQ(report.frames, 3);
}

TEST(Drawn, CgAloneIsTheLayerWithStraightAlpha) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 4);
  std::filesystem::create_directory(folder / "cg");
  folder.render(test::drawn_scene + "[output]\ncontent = \"cg\"\n",
                {.output = "cg/%03d.png", .layers_folder = folder.file("layers")});
  const auto alone = folder.frames("cg/%03d.png"), layers = folder.frames("layers/cg_%06d.png");
  ASSERT_EQ(alone.size(), 4u);
  EXPECT_EQ(drawn_frames(alone).size(), 4u);
  EXPECT_EQ(changed_frames(layers, alone), std::set<std::size_t>());
}

// How far the middle of what is drawn lies from the middle of the picture.
double offset_px(const Frame& layer) {
  double sum = 0, sum_x = 0, sum_y = 0;
  for (int y = 0; y < layer.format.height_px; ++y) {
    for (int x = 0; x < layer.format.width_px; ++x) {
      const int alpha = test::sample(layer, 3, x, y);
      sum += alpha;
      sum_x += alpha * x;
      sum_y += alpha * y;
    }
  }
  EXPECT_GT(sum, 0);
  return std::hypot(sum_x / sum - (layer.format.width_px - 1) / 2.0, sum_y / sum - (layer.format.height_px - 1) / 2.0);
}

TEST(Drawn, BarrelDistortionMovesTheCgTowardsTheMiddle) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 1);
  folder.write("poses.csv", pose_text({0}));
  const std::string scene =
      test::plate + test::poses + "[[object]]\nmesh = \"cube.obj\"\nheight_m = 0.2\nposition_m = [0.4, 0, 0.15]\n";
  folder.render(scene, {.output = "a.mkv", .codec = "ffv1", .layers_folder = folder.file("straight")});
  folder.write("camera.yml", ShotFolder::camera_text(64, 48, "-0.4, 0, 0, 0, 0"));
  folder.render(scene, {.output = "b.mkv", .codec = "ffv1", .layers_folder = folder.file("bent")});
  const double straight = offset_px(folder.frames("straight/cg_%06d.png").at(0));
  const double bent = offset_px(folder.frames("bent/cg_%06d.png").at(0));
  // Distortion takes a point at radius r to r (1 - 0.4 r^2). The cube is 8 px wide, not a point: its outer half shrinks
  // more than its inner one, which moves its middle by another quarter of that. Half is allowed.
  const double r = straight / 64;
  EXPECT_NEAR(bent, straight * (1 - 0.4 * r * r), straight * 0.4 * r * r / 2);
  EXPECT_GT(straight - bent, 0.3);
}

TEST(Drawn, NearerObjectHidesTheFarther) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 1);
  // Red is two metres behind blue in the camera's sight; either order in the file.
  folder.write("poses.csv", pose_text({0}));
  const std::string red =
      "[[object]]\nmesh = \"cube.obj\"\nheight_m = 0.5\ntoon = false\ncolour = \"#ff0000\"\n"
      "position_m = [0, 2, 0]\n";
  const std::string blue = "[[object]]\nmesh = \"cube.obj\"\nheight_m = 0.5\ntoon = false\ncolour = \"#0000ff\"\n";
  const std::string start = test::plate + test::poses;
  int count = 0;
  for (const std::string& scene : {start + red + blue, start + blue + red}) {
    const std::string layers = "layers" + std::to_string(++count);
    folder.render(scene,
                  {.output = "out.mkv", .codec = "ffv1", .layers_folder = folder.file(layers), .overwrite = true});
    const Frame layer = folder.frames(layers + "/cg_%06d.png").at(0);
    EXPECT_EQ(test::sample(layer, 3, 32, 24), 255);
    EXPECT_EQ(test::sample(layer, 0, 32, 24), 0) << "red shows through";
    EXPECT_EQ(test::sample(layer, 2, 32, 24), 255);
  }
}

// A stage that the plan leaves out never makes anything.
TEST(Unused, EmptySceneMakesNoGlObject) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 3);
  const gl::Made before = gl::made();
  const RenderReport report = folder.render(test::plate + test::locked, {.output = "out.mkv", .codec = "ffv1"});
  EXPECT_EQ(report.frames, 3);
  EXPECT_EQ(gl::made(), before);
}

TEST(Unused, OutlineThatNobodyWantsIsNotCompiled) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 1);
  const gl::Made plain = test::made_by(folder, test::drawn_scene);
  const gl::Made outlined = test::made_by(folder, test::drawn_scene + "outline = true\n");
  EXPECT_EQ(plain.contexts, 1);
  EXPECT_EQ(outlined.contexts, 1);
  EXPECT_GT(plain.programs, 0);
  EXPECT_LT(plain.programs, outlined.programs);
}

TEST(Unused, StagesThatDoNotRunAreNotReported) {
  const ShotFolder folder;
  folder.noise_clip("in.mkv", small, 2);
  const auto names = [&folder](const std::string& scene) {
    std::vector<std::string> stages;
    const RenderReport report = folder.render(scene, {.output = "out.mkv", .codec = "ffv1", .overwrite = true});
    for (const StageReport& stage : report.stages) {
      stages.push_back(stage.name);
      EXPECT_EQ(stage.times.count(), 2) << stage.name;
    }
    return stages;
  };
  EXPECT_EQ(names(test::plate), (std::vector<std::string>{"decode", "encode"}));
  EXPECT_EQ(names(test::drawn_scene), (std::vector<std::string>{"decode", "track", "draw", "composite", "encode"}));
}

double resident_mb() {
  long pages = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  return static_cast<double>(resident) * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1e6;
}

// Watches the memory from a frame on by which everything has been in use once.
struct MemoryWatch {
  int warm_frames;
  double warm_mb = 0, most_mb = 0;
  void operator()(std::int64_t done) {
    if (done == warm_frames) warm_mb = resident_mb();
    if (done > warm_frames && done % 50 == 0) most_mb = std::max(most_mb, resident_mb());
  }
  double growth_mb() const { return most_mb - warm_mb; }
};

TEST(Drawn, MemoryStaysFlatOver2000Frames) {
#ifdef RINKAKU_SANITIZED
  GTEST_SKIP() << "sanitizers keep freed memory on purpose";
#endif
  const ShotFolder folder(160, 120);
  test::ffmpeg("-f lavfi -i testsrc2=s=160x120:r=25 -frames:v 2000 -pix_fmt yuv420p -c:v mpeg4 '" +
               folder.file("in.mkv") + "'");
  MemoryWatch memory{200};
  folder.render(test::drawn_scene + "outline = true\n", {.output = "out.mkv", .codec = "mpeg4"},
                [&](std::int64_t done, std::int64_t) { memory(done); });
  ASSERT_GT(memory.warm_mb, 0);
  // One leaked picture a frame would be 52 MB; malloc's arenas of the five threads move by a few.
  EXPECT_LT(memory.growth_mb(), 10);
}

// The desk over and over, with sound: markers, smoothing, the lens and the copied stream all take and give memory.
TEST(Drawn, MemoryStaysFlatWithMarkersLensAndSound) {
#ifdef RINKAKU_SANITIZED
  GTEST_SKIP() << "sanitizers keep freed memory on purpose";
#endif
  const ShotFolder folder;
  const std::string recordings = std::string(RINKAKU_SOURCE_DIR) + "/recordings/";
  const std::string desk = recordings + "desk/";
  test::ffmpeg("-stream_loop 3 -i '" + desk + "video.mp4' -f lavfi -i sine=440:sample_rate=48000 -frames:v 600 " +
               "-shortest -vf scale=640:360 -pix_fmt yuv420p -c:v mpeg4 -q:v 2 -c:a aac '" + folder.file("in.mkv") +
               "'");
  // camera.yml at half the size: pixel middles count, so (646.3 + 0.5) / 2 - 0.5 = 322.9.
  folder.write("camera.yml",
               "%YAML:1.0\n---\nimage_width: 640\nimage_height: 360\ncamera_matrix: !!opencv-matrix\n   rows: 3\n"
               "   cols: 3\n   dt: d\n   data: [ 505.2, 0., 322.9, 0., 504.35, 177.15, 0., 0., 1. ]\n"
               "distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n"
               "   data: [ -0.162, 0.048, 0.0009, -0.0006, -0.0065 ]\n");
  MemoryWatch memory{200};
  const RenderReport report = folder.render(
      test::plate + "[track]\nboard = \"" + desk + "board.toml\"\n" + "[[object]]\nmesh = \"" + recordings +
          "meshes/mascot.glb\"\n" + "position_m = [0.1235, 0.091, 0]\nheight_m = 0.15\noutline = true\n",
      {.output = "out.mkv", .codec = "mpeg4"}, [&](std::int64_t done, std::int64_t) { memory(done); });
  EXPECT_EQ(report.frames, 600);
  EXPECT_EQ(report.posed_frames, 600);
  EXPECT_EQ(test::ffprobe("-select_streams a -show_entries stream=codec_name", folder.file("out.mkv")), "aac\n");
  ASSERT_GT(memory.warm_mb, 0);
  RecordProperty("growth_mb", std::to_string(memory.growth_mb()));
  // After 200 frames every view of the 150 has been seen once. 8 MB are 20 kB a frame, a tenth of its luma; malloc's
  // arenas of the threads, OpenCV's among them, move by 1 to 2 MB.
  EXPECT_LT(memory.growth_mb(), 8);
}

}  // namespace
}  // namespace rinkaku::pipeline
