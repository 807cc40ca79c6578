// The main job on a recording by other people.
#include <algorithm>

#include "tests/pipeline/shot_folder.h"

namespace rinkaku::pipeline {
namespace {

TEST(RealRecording, ObjectStandsOnTheMarkerInEveryFrame) {
  RINKAKU_NEEDS_DATA();
  const test::ShotFolder folder;
  const std::string recording = test::data("recordings/aruco_single").string();
  const std::string scene = "[plate]\nvideo = \"" + recording + "/video.avi\"\ncamera = \"" + recording +
                            "/intrinsics.yml\"\n"
                            "[track]\nmarker = { dictionary = \"ARUCO_ORIGINAL\", id = 101, size_m = 1 }\n"
                            "[[object]]\nmesh = \"" +
                            test::data("meshes/closed/oded_spot_23k.obj").string() +
                            "\"\nheight_m = 1\noutline = true\n";
  const RenderReport report =
      folder.render(scene, {.output = "out.mkv", .codec = "ffvhuff", .layers_folder = folder.file("layers")});
  EXPECT_EQ(report.frames, 145);
  EXPECT_EQ(report.posed_frames, 145);
  EXPECT_EQ(folder.frames("out.mkv").size(), 145u);
  const auto layers = source::open(folder.file("layers/cg_%06d.png"));
  int frames = 0;
  while (const auto layer = layers->next()) {
    int covered = 0;
    for (int y = 0; y < 480; ++y) {
      for (int x = 0; x < 640; ++x) covered += test::sample(*layer, 3, x, y) > 0;
    }
    // In the very last frames the marker is blurred away: its last pose is held, then the CG begins to fade.
    // As high as the marker is wide, which is about 100 pixels here: neither a speck nor half the picture.
    EXPECT_GT(covered, 1000) << "frame " << frames;
    EXPECT_LT(covered, 40000) << "frame " << frames;
    ++frames;
  }
  EXPECT_EQ(frames, 145);
}

}  // namespace
}  // namespace rinkaku::pipeline
