#include "pipeline/track/marker_tracker.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "pipeline/track/make_tracker.h"
#include "tests/pipeline/track/track_test_support.h"
#include "tests/support/test_data.h"

namespace rinkaku::track {
namespace {

using test::corner_distance_px;
using test::grey_frame;
using test::render;
using test::view_of;
using test::webcam;

// Sides are found to some hundredths of a pixel; a tenth leaves room for other noise. A marker of s px then has
// its distance to 0.1 / s of it, and twice that is asked for.
TEST(MarkerTracker, FindsASingleMarkersPoseThroughTheLens) {
  const CameraModel camera = webcam();
  const Board board = single_marker("test", "ARUCO_ORIGINAL", 101, 0.1);
  for (const double distance : {0.42, 0.7, 1.2}) {
    for (const double tilt : {0.2, 0.7, 1.0}) {
      // Off the middle, where the lens bends most.
      const glm::dvec3 centre(-0.25 * distance, 0.2 * distance, 0);
      RigidTransform truth = view_of({0, 0, 0}, distance, tilt, 1.3, 0.4);
      truth.translation_m += centre;
      const auto pose = make_marker_tracker(board, camera)->track(grey_frame(render(camera, board, truth), 3));
      ASSERT_TRUE(pose) << distance << " " << tilt;
      EXPECT_EQ(pose->frame_number, 3);
      const double side_px = 628 * 0.1 / distance;
      EXPECT_LT(corner_distance_px(camera, board, truth, pose->camera_from_world), 0.1) << distance << " " << tilt;
      EXPECT_LT(glm::distance(truth.translation_m, pose->camera_from_world.translation_m), distance * 0.2 / side_px)
          << distance << " " << tilt;
      EXPECT_LT(pose->reprojection_rms_px, 0.5);
    }
  }
}

TEST(MarkerTracker, FindsMarkersOfSixteenPixels) {
  const CameraModel camera = webcam();
  const Board board = single_marker("test", "4X4_50", 7, 0.1);
  for (const double side_px : {16.0, 24.0, 40.0, 300.0}) {
    const RigidTransform truth = view_of({0, 0, 0}, 628 * 0.1 / side_px, 0.3, 0.5, 0.2);
    const auto pose = make_marker_tracker(board, camera)->track(grey_frame(render(camera, board, truth)));
    ASSERT_TRUE(pose) << side_px;
    EXPECT_LT(corner_distance_px(camera, board, truth, pose->camera_from_world), 0.5) << side_px;
  }
}

TEST(MarkerTracker, SolvesABoardJointly) {
  const CameraModel camera = webcam();
  const Board board = grid_board("test", "4X4_50", {4, 3, 0.04, 0.01});
  const RigidTransform truth = view_of(board.centre_m(), 0.4, 0.6, 0.3, -0.2);
  const auto pose = make_marker_tracker(board, camera)->track(grey_frame(render(camera, board, truth)));
  ASSERT_TRUE(pose);
  // 48 corners average their errors.
  EXPECT_LT(corner_distance_px(camera, board, truth, pose->camera_from_world), 0.05);
  EXPECT_LT(test::angle_deg(truth.rotation, pose->camera_from_world.rotation), 0.1);
}

TEST(MarkerTracker, WorksOnPartOfABoard) {
  const CameraModel camera = webcam();
  const Board board = grid_board("test", "4X4_50", {4, 3, 0.04, 0.01});
  RigidTransform truth = view_of(board.centre_m(), 0.3, 0.4, 0.3, 0);
  truth.translation_m.x += 0.14;  // two columns are out of the picture
  const auto pose = make_marker_tracker(board, camera)->track(grey_frame(render(camera, board, truth)));
  ASSERT_TRUE(pose);
  EXPECT_LT(
      glm::distance(truth * board.markers[0].corners_m[0], pose->camera_from_world * board.markers[0].corners_m[0]),
      0.3 * 0.01);
}

// A marker of the board lies elsewhere (a second print, or a moved one): what most others say holds.
TEST(MarkerTracker, LeavesOutAMarkerThatLiesWrong) {
  const CameraModel camera = webcam();
  const Board board = grid_board("test", "4X4_50", {3, 2, 0.04, 0.02});
  Board filmed = board;
  for (glm::dvec3& corner : filmed.markers[2].corners_m) corner += glm::dvec3(0.015, 0.02, 0);
  const RigidTransform truth = view_of(board.centre_m(), 0.4, 0.5, 0.9, 0.1);
  const auto pose = make_marker_tracker(board, camera)->track(grey_frame(render(camera, filmed, truth)));
  ASSERT_TRUE(pose);
  EXPECT_LT(corner_distance_px(camera, board, truth, pose->camera_from_world), 0.3);
  EXPECT_LT(pose->reprojection_rms_px, 0.5);
}

TEST(MarkerTracker, GivesNothingWhereNoMarkerIs) {
  const CameraModel camera = webcam();
  const Board board = single_marker("test", "ARUCO_ORIGINAL", 101, 0.1);
  auto tracker = make_marker_tracker(board, camera);
  cv::Mat noise(480, 640, CV_8U);
  cv::RNG random(3);
  for (int i = 0; i < 5; ++i) {
    random.fill(noise, cv::RNG::UNIFORM, 0, 256);
    EXPECT_FALSE(tracker->track(grey_frame(noise.clone(), i)));
    cv::GaussianBlur(noise, noise, {}, 4 + i);
    cv::normalize(noise, noise, 0, 255, cv::NORM_MINMAX);
    EXPECT_FALSE(tracker->track(grey_frame(noise.clone(), i)));
  }
  // Another id of the same dictionary is not it.
  const Board other = single_marker("test", "ARUCO_ORIGINAL", 701, 0.1);
  EXPECT_FALSE(tracker->track(grey_frame(render(camera, other, view_of({0, 0, 0}, 0.5, 0.3, 0, 0)))));
}

TEST(MarkerTracker, SurvivesPicturesOfAnySize) {
  const Board board = single_marker("test", "4X4_50", 0, 0.1);
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(3, 1), cv::Size(1, 200), cv::Size(17, 33), cv::Size(641, 479)}) {
    CameraModel camera = webcam();
    camera.width_px = size.width;
    camera.height_px = size.height;
    auto tracker = make_marker_tracker(board, camera);
    EXPECT_FALSE(tracker->track(grey_frame(cv::Mat(size, CV_8U, cv::Scalar(128))))) << size;
    EXPECT_FALSE(tracker->track(grey_frame(cv::Mat(480, 640, CV_8U, cv::Scalar(128)))))
        << "another size than the camera's";
  }
}

TEST(MarkerTracker, RefusesChessboards) {
  EXPECT_REFUSED(make_marker_tracker(chessboard("board.toml", {9, 6, 0.02}), webcam()),
                 "board.toml: this board has no markers");
}

TEST(MarkerTracker, ReadsABlurredMarkerWhereItWas) {
  const CameraModel camera = webcam();
  const Board board = single_marker("test", "ARUCO_ORIGINAL", 101, 0.1);
  auto tracker = make_marker_tracker(board, camera);
  const RigidTransform truth = view_of({0, 0, 0}, 0.7, 0.5, 0.8, 0.3);
  ASSERT_TRUE(tracker->track(grey_frame(render(camera, board, truth), 0)));
  cv::Mat blurred = render(camera, board, truth);
  cv::blur(blurred, blurred, {19, 1});  // one and a half cells of motion: no bit reader reads that
  const auto pose = tracker->track(grey_frame(blurred, 1));
  ASSERT_TRUE(pose);
  // Where a corner lies along the blur, nobody can say: within its half length.
  EXPECT_LT(corner_distance_px(camera, board, truth, pose->camera_from_world), 9.5);
}

// A still marker of 60 px under sensor noise: the steadied pose jitters less from frame to frame and lies nearer.
TEST(MarkerTracker, SmoothedJittersLess) {
  const CameraModel camera = webcam();
  const Board board = single_marker("test", "4X4_50", 3, 0.1);
  const RigidTransform truth = view_of({0, 0, 0}, 1.0, 0.6, 0.8, 0.3);
  auto raw = make_marker_tracker(board, camera);
  TrackOptions options;
  options.from = FromMarker{"4X4_50", 3, 0.1};
  options.smoothing = OneEuroOptions{};
  auto smooth = make_tracker(options, camera);
  double raw_jitter = 0, smooth_jitter = 0;
  std::optional<TrackedPose> raw_before, smooth_before;
  for (int i = 0; i < 45; ++i) {
    const Frame frame = grey_frame(render(camera, board, truth, {6, 0.6, static_cast<unsigned>(i + 1)}), i);
    const auto r = raw->track(frame), s = smooth->track(frame);
    ASSERT_TRUE(r && s);
    if (i > 15) {
      raw_jitter += corner_distance_px(camera, board, r->camera_from_world, raw_before->camera_from_world);
      smooth_jitter += corner_distance_px(camera, board, s->camera_from_world, smooth_before->camera_from_world);
    }
    raw_before = r;
    smooth_before = s;
  }
  RecordProperty("raw_jitter_px", std::to_string(raw_jitter / 29));
  RecordProperty("smooth_jitter_px", std::to_string(smooth_jitter / 29));
  EXPECT_LT(smooth_jitter, 0.5 * raw_jitter);
}

}  // namespace
}  // namespace rinkaku::track
