#include "pipeline/track/ahead.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>

#include <glm/geometric.hpp>
#include <opencv2/core.hpp>

#include "pipeline/track/board.h"
#include "pipeline/track/camera_file.h"
#include "pipeline/track/pose_file.h"
#include "tests/pipeline/track/track_test_support.h"

namespace rinkaku::track {
namespace {

TrackedPose pose_at(double x_m, double turn) {
  TrackedPose pose;
  pose.camera_from_world.translation_m = {x_m, 0, 1};
  pose.camera_from_world.rotation = glm::angleAxis(turn, glm::dvec3(0, 1, 0));
  return pose;
}

TEST(PosePredictor, ContinuesEvenMotion) {
  PosePredictor predictor;
  EXPECT_FALSE(predictor.at(0));
  predictor.add(1.00, pose_at(0.10, 0.2));
  EXPECT_EQ(predictor.at(1.05)->camera_from_world.translation_m.x, 0.10) << "one pose has no motion";
  predictor.add(1.04, pose_at(0.14, 0.3));
  const auto later = predictor.at(1.06);
  EXPECT_NEAR(later->camera_from_world.translation_m.x, 0.16, 1e-12);
  EXPECT_LT(test::angle_deg(later->camera_from_world.rotation, glm::angleAxis(0.35, glm::dvec3(0, 1, 0))), 1e-5);
  EXPECT_TRUE(later->held);
  // A camera that is late by more than that has stopped for all one knows.
  EXPECT_NEAR(predictor.at(9)->camera_from_world.translation_m.x, 0.14 + PosePredictor::longest_s, 1e-12);
  // What was measured is given as it was.
  EXPECT_FALSE(predictor.at(1.04)->held);
}

TEST(PosePredictor, TimesThatFallOrStandStillBeginAnew) {
  PosePredictor predictor;
  predictor.add(1.00, pose_at(0.1, 0));
  for (const double time_s : {1.00, 0.5, 0.5001, std::nan("")}) {
    predictor.add(time_s, pose_at(0.3, 0));
    EXPECT_EQ(predictor.at(2.0)->camera_from_world.translation_m.x, 0.3) << time_s;
  }
}

// A camera moved as a hand does: one frame ahead, the board's place is predicted nearer than by the old pose.
TEST(PosePredictor, IsNearerThanTheLastPoseOnARecording) {
  const PoseTable table = read_poses(RINKAKU_SOURCE_DIR "/recordings/desk/poses.csv");
  const auto& poses = table.poses();
  ASSERT_GT(poses.size(), 50u);
  const CameraModel camera = read_camera(RINKAKU_SOURCE_DIR "/recordings/desk/camera.yml");
  const Board board = read_board(RINKAKU_SOURCE_DIR "/recordings/desk/board.toml");
  PosePredictor predictor;
  double predicted_px = 0, held_px = 0;
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    TrackedPose pose;
    pose.camera_from_world = inverse(poses[i].world_from_camera);
    const double time_s = static_cast<double>(i) / 25;
    predictor.add(time_s, pose);
    if (i == 0) continue;
    const RigidTransform truth = inverse(poses[i + 1].world_from_camera);
    predicted_px += test::corner_distance_px(camera, board, truth, predictor.at(time_s + 0.04)->camera_from_world);
    held_px += test::corner_distance_px(camera, board, truth, pose.camera_from_world);
  }
  RecordProperty("predicted_px", std::to_string(predicted_px / static_cast<double>(poses.size())));
  RecordProperty("held_px", std::to_string(held_px / static_cast<double>(poses.size())));
  EXPECT_LT(predicted_px, 0.7 * held_px);  // a hand trembles: half of what is left changes within a frame
}

// Answers only when it is let go.
class Gated final : public Tracker {
 public:
  std::optional<TrackedPose> track(const Frame& frame) override {
    ++begun;
    while (!open) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (fails) throw std::runtime_error("broken");
    last = frame.number;
    TrackedPose pose = pose_at(0.01 * static_cast<double>(frame.number), 0);
    pose.frame_number = frame.number;
    ++done;
    return pose;
  }
  std::atomic<int> begun{0}, done{0};
  std::atomic<std::int64_t> last{-1};
  std::atomic<bool> open{false}, fails{false};
};

template <typename Until>
void wait_for(const Until& until) {
  for (int i = 0; i < 20000 && !until(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ASSERT_TRUE(until());
}

TEST(AheadTracker, NeverWaitsAndTracksTheNewest) {
  auto owned = std::make_unique<Gated>();
  Gated& gated = *owned;
  const auto tracker = make_ahead(std::move(owned));
  const cv::Mat grey(4, 4, CV_8U, cv::Scalar(7));
  EXPECT_FALSE(tracker->track(test::grey_frame(grey, 0)));
  wait_for([&] { return gated.begun == 1; });
  // Would never return if it waited.
  for (int i = 1; i <= 5; ++i) EXPECT_FALSE(tracker->track(test::grey_frame(grey, i)));
  gated.open = true;
  wait_for([&] { return gated.done == 2; });
  EXPECT_EQ(gated.last, 5) << "what lay between was passed over";
  // Frames 0 and 5 are known, 0.01 m a frame.
  wait_for([&] {
    const auto pose = tracker->track(test::grey_frame(grey, 6));
    return pose && std::abs(pose->camera_from_world.translation_m.x - 0.06) < 1e-9 && pose->frame_number == 6;
  });
}

TEST(AheadTracker, HandsOnWhatTheTrackerThrows) {
  auto owned = std::make_unique<Gated>();
  owned->open = owned->fails = true;
  const auto tracker = make_ahead(std::move(owned));
  const cv::Mat grey(4, 4, CV_8U, cv::Scalar(7));
  bool thrown = false;
  for (int i = 0; i < 20000 && !thrown; ++i) {
    try {
      tracker->track(test::grey_frame(grey, i));
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    } catch (const std::runtime_error& error) {
      thrown = std::string(error.what()) == "broken";
    }
  }
  EXPECT_TRUE(thrown);
}

}  // namespace
}  // namespace rinkaku::track
