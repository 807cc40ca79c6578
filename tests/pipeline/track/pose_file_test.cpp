#include "pipeline/track/pose_file.h"

#include <fstream>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/pipeline/track/track_test_support.h"
#include "tests/support/test_data.h"

namespace rinkaku::track {
namespace {

using test::write;

class PoseFile : public testing::Test {
 protected:
  PoseTable read(const std::string& text) { return read_poses(write(folder_ / "poses.csv", text)); }
  rinkaku::test::TemporaryFolder folder_;
};

const std::string header = "frame,time_s,tx,ty,tz,qx,qy,qz,qw\n";

TEST_F(PoseFile, FindsPosesByFrameNumber) {
  const PoseTable poses = read(header + "0,0.0,1,2,3,0,0,0,1\n1,0.04,4,5,6,0,0,0.6,0.8\n3,0.12,7,8,9,0,0,0,2\n");
  EXPECT_TRUE(poses.by_frame());
  const auto one = poses.world_from_camera(1, 99);
  ASSERT_TRUE(one);
  EXPECT_EQ(one->translation_m, glm::dvec3(4, 5, 6));
  EXPECT_NEAR(one->rotation.z, 0.6, 1e-15);
  EXPECT_NEAR(one->rotation.w, 0.8, 1e-15);
  EXPECT_FALSE(poses.world_from_camera(2, 0.04));
  EXPECT_FALSE(poses.world_from_camera(-1, 0));
  EXPECT_FALSE(poses.world_from_camera(4, 0));
  EXPECT_NEAR(poses.world_from_camera(3, 0)->rotation.w, 1, 1e-15) << "brought to unit length";
}

TEST_F(PoseFile, InterpolatesByTimeInsideItsSpan) {
  // A quarter turn about z: half way it is an eighth.
  const PoseTable poses = read("time_s,tx,ty,tz,qx,qy,qz,qw\n1,0,0,0,0,0,0,1\n2,10,0,-2,0,0,-0.70710678,-0.70710678\n");
  const auto half = poses.world_from_camera(0, 1.5);
  ASSERT_TRUE(half);
  EXPECT_NEAR(half->translation_m.x, 5, 1e-12);
  EXPECT_NEAR(half->translation_m.z, -1, 1e-12);
  EXPECT_NEAR(test::angle_deg(half->rotation, glm::angleAxis(M_PI / 4, glm::dvec3(0, 0, 1))), 0, 1e-5);
  EXPECT_TRUE(poses.world_from_camera(0, 1));
  EXPECT_TRUE(poses.world_from_camera(0, 2));
  EXPECT_FALSE(poses.world_from_camera(0, 0.999));
  EXPECT_FALSE(poses.world_from_camera(0, 2.001));
  EXPECT_FALSE(poses.world_from_camera(0, std::nan("")));
}

TEST_F(PoseFile, CountsTimeFromTheVideosFirstFrame) {
  auto tracker = make_pose_file_tracker(read("time_s,tx,ty,tz,qx,qy,qz,qw\n0,0,0,0,0,0,0,1\n1,10,0,0,0,0,0,1\n"), 1.5);
  Frame frame;
  frame.time_base = {1, 1000};
  frame.pts = 1750;
  ASSERT_TRUE(tracker->track(frame));
  EXPECT_NEAR(tracker->track(frame)->camera_from_world.translation_m.x, -2.5, 1e-12);
  frame.pts = 500;
  EXPECT_FALSE(tracker->track(frame));
}

TEST_F(PoseFile, GivesTheCameraFromTheWorld) {
  // A camera at (1, 2, 3) turned a quarter about z.
  auto tracker = make_pose_file_tracker(read(header + "5,,1,2,3,0,0,0.7071067811865476,0.7071067811865476\n"));
  Frame frame;
  frame.number = 4;
  EXPECT_FALSE(tracker->track(frame));
  frame.number = 5;
  const auto pose = tracker->track(frame);
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->frame_number, 5);
  EXPECT_FALSE(pose->held);
  const glm::dvec3 origin = pose->camera_from_world * glm::dvec3(1, 2, 3);
  EXPECT_NEAR(glm::length(origin), 0, 1e-12) << "the camera sees itself at its own origin";
  // The camera's x axis points along world y.
  EXPECT_NEAR(glm::distance(pose->camera_from_world * glm::dvec3(1, 3, 3), glm::dvec3(1, 0, 0)), 0, 1e-12);
}

TEST_F(PoseFile, ReadsTumWithComments) {
  const PoseTable poses = read(
      "# timestamp tx ty tz qx qy qz qw\n\n1305031102.175304 1.3405 0.6266 1.6575 0.6574 0.6126 -0.2949 -0.3248 # one\n"
      "1305031102.211214\t1.3303 0.6256 1.6464 0.6579 0.6161 -0.2932 -0.3189\r\n");
  EXPECT_FALSE(poses.by_frame());
  ASSERT_EQ(poses.poses().size(), 2u);
  EXPECT_NEAR(poses.world_from_camera(0, 1305031102.175304)->translation_m.x, 1.3405, 1e-9);
}

TEST_F(PoseFile, SortsLines) {
  const PoseTable poses = read(header + "2,,2,0,0,0,0,0,1\n0,,0,0,0,0,0,0,1\n1,,1,0,0,0,0,0,1\n");
  for (int i = 0; i < 3; ++i) EXPECT_EQ(poses.world_from_camera(i, 0)->translation_m.x, i);
}

TEST_F(PoseFile, TakesColumnsInAnyOrder) {
  const PoseTable poses = read("qw,qx,qy,qz,tx,ty,tz,frame\n1,0,0,0,7,8,9,0\n");
  EXPECT_EQ(poses.world_from_camera(0, 0)->translation_m, glm::dvec3(7, 8, 9));
}

TEST_F(PoseFile, NamesTheLineOfWhatIsWrong) {
  EXPECT_REFUSED(read(""), "no poses");
  EXPECT_REFUSED(read(header), "no poses");
  EXPECT_REFUSED(read(header + "0,0,0,0,0,0,0,0,1\n\n1,0,0,0,0,0,0,0,0\n"), "poses.csv:4: the quaternion is zero");
  EXPECT_REFUSED(read(header + "0,0,0,0,nan,0,0,0,1\n"), "poses.csv:2: \"nan\" in column tz");
  EXPECT_REFUSED(read(header + "0,0,0,0,inf,0,0,0,1\n"), "is not a finite number");
  EXPECT_REFUSED(read(header + "0,0,0,0,0,0,0,0,1e999\n"), "is not a finite number");
  EXPECT_REFUSED(read(header + "0,0,0,1x,0,0,0,0,1\n"), "\"1x\" in column ty");
  EXPECT_REFUSED(read(header + "0,0,0,0,0,0,0,1\n"), "8 fields instead of 9");
  EXPECT_REFUSED(read(header + "0.5,0,0,0,0,0,0,0,1\n"), "is not a frame number");
  EXPECT_REFUSED(read(header + "-1,0,0,0,0,0,0,0,1\n"), "is not a frame number");
  EXPECT_REFUSED(read(header + "1,,0,0,0,0,0,0,1\n2,,0,0,0,0,0,0,1\n1,,0,0,0,0,0,0,1\n"),
                 "poses.csv:4: this frame number");
  EXPECT_REFUSED(read(header + "1,,0,0,0,0,0,0,1\n,0.5,0,0,0,0,0,0,1\n"), "fill one of the columns");
  EXPECT_REFUSED(read(header + ",,0,0,0,0,0,0,1\n"), "neither frame nor time");
  EXPECT_REFUSED(read("frame,tx,ty,tz,qx,qy,qz\n"), "\"qw\" is missing");
  EXPECT_REFUSED(read("frame,tx,ty,tz,qx,qy,qz,qw,roll\n"), "unknown column \"roll\"");
  EXPECT_REFUSED(read("frame,frame,ty,tz,qx,qy,qz,qw\n"), "comes twice");
  EXPECT_REFUSED(read("tx,ty,tz,qx,qy,qz,qw\n"), "neither of the columns");
  EXPECT_REFUSED(read("0 0 0 0 0 0 1\n"), "poses.csv:1: 7 fields instead of 8");
  EXPECT_REFUSED(read_poses(folder_ / "none.csv"), "no such file");
}

TEST_F(PoseFile, OfARealRecordingPutsTheDepthOfTwoFramesTogether) {
  RINKAKU_NEEDS_DATA();
  // posefile_rgbd: camera-to-world poses without timestamps; number them as TUM lines.
  std::ifstream in(rinkaku::test::data("recordings/posefile_rgbd/pose.txt"));
  std::string line, tum = "# five frames\n";
  for (int i = 0; std::getline(in, line); ++i) tum += std::to_string(i) + ".5 " + line + "\n";
  const PoseTable poses = read(tum);
  ASSERT_EQ(poses.poses().size(), 5u);
  const auto first = poses.world_from_camera(0, 0.5);
  ASSERT_TRUE(first);
  EXPECT_NEAR(first->translation_m.x, -0.228993, 1e-9);
  EXPECT_NEAR(first->rotation.w, 0.993042, 1e-5);
  // Between frames the camera is between its places.
  EXPECT_NEAR(poses.world_from_camera(0, 1.0)->translation_m.x, (-0.228993 - 0.50237) / 2, 1e-9);
}

}  // namespace
}  // namespace rinkaku::track
