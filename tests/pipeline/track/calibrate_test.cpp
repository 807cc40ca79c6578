#include "pipeline/track/calibrate.h"

#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/pipeline/track/track_test_support.h"

namespace rinkaku::track {
namespace {

using test::grey_frame;
using test::render;
using test::view_of;

// Frames of a board from many sides, as a person would film them.
std::vector<Frame> film(const CameraModel& camera, const Board& board, int count, double most_tilt) {
  std::vector<Frame> frames;
  for (int i = 0; i < count; ++i) {
    const double turn = 2.4 * i;  // the golden angle: all around
    const double tilt = most_tilt * (0.3 + 0.7 * (i % 3) / 2.0);
    const double distance = board.radius_m() * (3.0 + 0.8 * (i % 4));
    RigidTransform pose = view_of(board.centre_m(), distance, tilt, turn, 0.3 * std::sin(turn));
    pose.translation_m += glm::dvec3(0.22 * std::cos(turn), 0.16 * std::sin(turn), 0) * distance;
    frames.push_back(grey_frame(render(camera, board, pose, {2, 0.6, static_cast<unsigned>(i + 1)}), i, {1, 5}));
  }
  return frames;
}

std::function<std::optional<Frame>()> from(const std::vector<Frame>& frames) {
  return [frames, i = std::size_t{0}]() mutable -> std::optional<Frame> {
    if (i >= frames.size()) return {};
    return frames[i++];
  };
}

// How far apart two cameras see the same rays, in pixels: root mean square over the picture's inner nine tenths. This
// is what matters; single parameters trade off against one another.
double model_distance_px(const CameraModel& truth, const CameraModel& found) {
  double sum = 0;
  int count = 0;
  for (double y = 0.05; y <= 0.95; y += 0.1) {
    for (double x = 0.05; x <= 0.95; x += 0.1) {
      const glm::dvec2 px(x * truth.width_px, y * truth.height_px);
      const auto ray = undistort(truth, to_normalised(truth, px), max_undistorted_radius(truth));
      if (!ray) continue;
      const glm::dvec2 d = to_pixels(found, distort(found, *ray)) - px;
      sum += glm::dot(d, d);
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

CameraModel true_camera() {
  CameraModel camera{640, 480, 620, 618, 326, 236, {}};
  camera.distortion = {-0.18, 0.05, 0.001, -0.0015, 0};
  return camera;
}

TEST(Calibrate, FindsTheCameraFromAnyKindOfBoard) {
  const CameraModel camera = true_camera();
  for (const Board& board :
       {chessboard("chess", {9, 7, 0.02}), charuco_board("charuco", "4X4_50", {8, 6, 0.025, 0.018}),
        grid_board("grid", "4X4_50", {5, 4, 0.03, 0.01})}) {
    const Calibration result = calibrate(board, from(film(camera, board, 16, 0.7)));
    EXPECT_GE(result.views, 10) << board.name;
    EXPECT_EQ(result.frames_looked_at, 16) << board.name;
    EXPECT_EQ(result.camera.width_px, 640);
    // Blur draws marker corners inwards by a tenth or two of a pixel; chess corners stay.
    const bool markers_only = board.layout == Board::Layout::Grid;
    EXPECT_LT(result.rms_px, markers_only ? 0.4 : 0.2) << board.name;
    EXPECT_LT(model_distance_px(camera, result.camera), markers_only ? 4.0 : 1.5) << board.name;
    EXPECT_NEAR(result.camera.fx_px, 620, 620 * 0.01) << board.name;
    EXPECT_TRUE(result.warnings.empty()) << board.name << ": " << result.warnings.front();
    RecordProperty(board.name + "_rms_px", std::to_string(result.rms_px));
    RecordProperty(board.name + "_model_px", std::to_string(model_distance_px(camera, result.camera)));
  }
}

TEST(Calibrate, WarnsOfFewAndFlatViews) {
  const CameraModel camera = true_camera();
  const Board board = chessboard("chess", {9, 7, 0.02});
  const Calibration result = calibrate(board, from(film(camera, board, 6, 0.1)));
  ASSERT_GE(result.warnings.size(), 2u);
  EXPECT_NE(result.warnings[0].find("views were used"), std::string::npos);
  const auto all = result.warnings[0] + result.warnings[1] + result.warnings.back();
  EXPECT_NE(all.find("parallel"), std::string::npos);
}

TEST(Calibrate, LeavesOutBlurredFramesAndWrongViews) {
  const CameraModel camera = true_camera();
  const Board board = charuco_board("charuco", "4X4_50", {8, 6, 0.025, 0.018});
  auto frames = film(camera, board, 16, 0.7);
  // One frame filmed by another lens, one blurred.
  CameraModel other = camera;
  other.fx_px = other.fy_px = 900;
  other.cx_px = 250;
  frames[5] = film(other, board, 6, 0.7).back();
  const Calibration result = calibrate(board, from(frames));
  EXPECT_GE(result.views_rejected, 1);
  EXPECT_LT(model_distance_px(camera, result.camera), 1.5);
}

TEST(Calibrate, RefusesWhatCannotBeCalibrated) {
  const Board board = chessboard("chess.toml", {9, 7, 0.02});
  const std::vector<Frame> empty(3, grey_frame(cv::Mat(480, 640, CV_8U, cv::Scalar(128))));
  EXPECT_REFUSED(calibrate(board, from({})), "chess.toml: the board was seen in 0 of 0 frames");
  EXPECT_REFUSED(calibrate(board, from(empty)), "not the inner corners");
  std::vector<Frame> mixed = empty;
  mixed.push_back(grey_frame(cv::Mat(240, 320, CV_8U, cv::Scalar(128)), 30));
  EXPECT_REFUSED(calibrate(board, from(mixed)), "differ in size");
  Board bent = grid_board("bent", "4X4_50", {2, 2, 0.03, 0.01});
  bent.markers[0].corners_m[0].z = 0.01;
  EXPECT_REFUSED(calibrate(bent, from(empty)), "one plane");
}

}  // namespace
}  // namespace rinkaku::track
