#include "pipeline/matte/difference.h"

#include "tests/pipeline/matte/matte_tools.h"

namespace rinkaku::matte {
namespace {

using test::Agreement;

// The shipped recording with its true matte; every third frame from where half of the walker is in the picture, which
// keeps the test short. The bounds are a little below what is reached.
TEST(DifferenceMatte, FindsTheWalkerBeforeACleanPlate) {
  const auto video = source::open(test::tripod + "video.mp4");
  const auto truth = test::file_matte(test::tripod + "matte.mkv");
  DifferenceMatte estimator(source::open(test::tripod + "clean.jpg")->next());
  Matte found, wish;
  Agreement agreement;
  while (const auto frame = video->next()) {
    const bool room_is_empty = frame->number < 10;
    if (!room_is_empty && frame->number % 3 != 0) continue;
    estimator.estimate(*frame, found);
    EXPECT_EQ(found.frame_number, frame->number);
    if (room_is_empty) {
      EXPECT_LT(cv::countNonZero(test::alpha_of(found) > 127), 1500) << "frame " << frame->number;
    }
    if (frame->number < 18) continue;
    truth->estimate(*frame, wish);
    agreement.add(found, wish);
  }
  EXPECT_GE(agreement.iou(), 0.97);
  EXPECT_GE(agreement.boundary_f3(), 0.95);
}

TEST(DifferenceMatte, LearnsTheRoomFromTheFrames) {
  const auto video = source::open(test::tripod + "video.mp4");
  const auto truth = test::file_matte(test::tripod + "matte.mkv");
  DifferenceMatte estimator(std::nullopt);
  Matte found, wish;
  Agreement agreement;
  while (const auto frame = video->next()) {
    if (frame->number > 90) break;
    estimator.estimate(*frame, found);
    if (frame->number < 60 || frame->number % 5 != 0) continue;
    truth->estimate(*frame, wish);
    agreement.add(found, wish);
  }
  // Less than with a clean plate: the walker stays before the same wall for half a second.
  EXPECT_GT(agreement.iou(), 0.9);
}

// A grey card half in a shadow that falls over a grey room, under light that has changed by a tenth.
TEST(DifferenceMatte, ShadowsAndOtherLightAreNoThings) {
  const int width = 640, height = 360;
  DifferenceMatte estimator(test::plain_frame(width, height, 140, 120, 135));
  Frame frame = test::plain_frame(width, height, 128, 120, 135);  // (128 - 16) / (140 - 16): 0.9 of the light
  for (int y = 100; y < 260; ++y) {
    std::uint8_t* row = frame.planes[0].data + y * frame.planes[0].stride_bytes;
    std::fill(row + 60, row + 260, std::uint8_t{16 + 78});  // a shadow: 0.7 of the light
    std::fill(row + 400, row + 520, std::uint8_t{235});     // a white card
  }
  Matte found;
  estimator.estimate(frame, found);
  const cv::Mat inside = test::alpha_of(found) > 127;
  // The card to a pixel around it, and nothing else.
  EXPECT_NEAR(cv::countNonZero(inside(cv::Rect(390, 90, 140, 180))), 120 * 160, 2 * (120 + 160) * 1);
  EXPECT_EQ(cv::countNonZero(inside(cv::Rect(0, 0, 380, height))), 0);
}

TEST(DifferenceMatte, OwnColoursAreFreeOfTheBackground) {
  const int width = 320, height = 180;
  // A white card before black: along its edge the filmed pixels are grey, its own colour is white.
  DifferenceMatte estimator(test::plain_frame(width, height, 40, 128, 128));
  Frame frame = test::plain_frame(width, height, 40, 128, 128);
  for (int y = 40; y < 140; ++y) {
    std::uint8_t* row = frame.planes[0].data + y * frame.planes[0].stride_bytes;
    std::fill(row + 100, row + 200, std::uint8_t{235});
    row[99] = row[200] = (40 + 235) / 2;
  }
  Matte found;
  estimator.estimate(frame, found);
  const std::size_t edge = 90u * width + 99;
  ASSERT_GT(found.alpha[edge], 60);
  ASSERT_LT(found.alpha[edge], 200);
  // Alpha is known to some tenth, and the colour with it; what was filmed there is 145.
  EXPECT_GT(found.own_rgb[3 * edge], 215);
  EXPECT_EQ(found.alpha[90u * width + 150], 255);
  EXPECT_EQ(found.alpha[90u * width + 20], 0);
}

}  // namespace
}  // namespace rinkaku::matte
