// Markers as they should not be filmed: tiny, face to face, nearly edge on, half outside the picture.
#include <cmath>

#include <glm/geometric.hpp>
#include <opencv2/imgproc.hpp>

#include "pipeline/track/marker_tracker.h"
#include "tests/pipeline/track/track_test_support.h"

namespace rinkaku::track {
namespace {

using test::corner_distance_px;
using test::grey_frame;
using test::render;
using test::view_of;
using test::webcam;

constexpr double side_m = 0.1;

Board marker() { return single_marker("test", "4X4_50", 7, side_m); }

double distance_for(double side_px) { return 628 * side_m / side_px; }

std::optional<TrackedPose> tracked(const RigidTransform& truth, const Board& board = marker()) {
  return make_marker_tracker(board, webcam())->track(grey_frame(render(webcam(), board, truth)));
}

// A cell of an 8-pixel marker is 1.3 pixels wide: it may be missed, but what is found must be it.
TEST(ExtremeMarker, OfEightPixelsIsFoundRightlyOrNotAtAll) {
  int found = 0;
  for (int i = 0; i < 12; ++i) {
    const RigidTransform truth = view_of({0, 0, 0}, distance_for(8), 0.1 + 0.05 * i, 0.5 * i, 0.3 * i);
    const auto pose = tracked(truth);
    if (!pose) continue;
    ++found;
    EXPECT_LT(corner_distance_px(webcam(), marker(), truth, pose->camera_from_world), 1) << i;
  }
  RecordProperty("found_of_12", found);
}

// Seen face to face both poses of a square coincide nearly: its corners are right whichever is taken.
TEST(ExtremeMarker, FaceToFaceHasItsCornersInPlace) {
  for (const double side_px : {24.0, 60.0, 200.0}) {
    for (const double roll : {0.0, 0.7}) {
      const RigidTransform truth = view_of({0, 0, 0}, distance_for(side_px), 0, 0, roll);
      const auto pose = tracked(truth);
      ASSERT_TRUE(pose) << side_px;
      EXPECT_LT(corner_distance_px(webcam(), marker(), truth, pose->camera_from_world), 0.3) << side_px;
      EXPECT_LT(glm::distance(truth.translation_m, pose->camera_from_world.translation_m),
                0.02 * truth.translation_m.z);
    }
  }
}

// At 80 degrees a marker of 150 px is 26 px high: it may be missed, but its pose may not be another's.
TEST(ExtremeMarker, GrazinglySeenIsFoundRightlyOrNotAtAll) {
  int found = 0;
  for (const double degrees : {60.0, 70.0, 75.0, 80.0, 83.0, 86.0, 89.0}) {
    const RigidTransform truth = view_of({0, 0, 0}, distance_for(150), degrees / 180 * M_PI, 0.9, 0.2);
    const auto pose = tracked(truth);
    if (!pose) {
      EXPECT_GT(degrees, 75) << "still as high as a quarter of its width";
      continue;
    }
    ++found;
    EXPECT_LT(corner_distance_px(webcam(), marker(), truth, pose->camera_from_world), 1) << degrees;
    EXPECT_LT(test::angle_deg(truth.rotation, pose->camera_from_world.rotation), 3) << degrees;
  }
  EXPECT_GE(found, 3);
}

// Half outside there is no square, so no pose; it is the same marker that comes back.
TEST(ExtremeMarker, HalfOutsideIsNotFoundAndComesBackWhereItIs) {
  const Board board = marker();
  auto tracker = make_marker_tracker(board, webcam());
  const RigidTransform inside = view_of({0, 0, 0}, distance_for(120), 0.4, 0.5, 0.1);
  for (int i = 0; i <= 8; ++i) {
    RigidTransform truth = inside;
    truth.translation_m.x += 0.6 * inside.translation_m.z * std::sin(M_PI * i / 8);  // out of the picture and back
    const auto pose = tracker->track(grey_frame(render(webcam(), board, truth), i));
    const double centre_px = 320 + 628 * truth.translation_m.x / truth.translation_m.z;
    if (centre_px > 640) {
      EXPECT_FALSE(pose) << i;
    } else if (pose) {
      EXPECT_LT(corner_distance_px(webcam(), board, truth, pose->camera_from_world), 0.5) << i;
    }
    if (i == 0 || i == 8) {
      EXPECT_TRUE(pose) << i;
    }
  }
}

}  // namespace
}  // namespace rinkaku::track
