#include "pipeline/matte/chroma.h"

#include "pipeline/frame/error.h"
#include "pipeline/matte/picture.h"
#include "report/sections/before_screen.h"
#include "tests/pipeline/matte/matte_tools.h"

namespace rinkaku::matte {
namespace {

using test::Agreement;

TEST(ChromaMatte, FindsTheWalkerBeforeAScreenThatItPicksItself) {
  const auto video = source::open(test::tripod + "video.mp4");
  const auto truth = test::file_matte(test::tripod + "matte.mkv");
  const auto clean = source::open(test::tripod + "clean.jpg")->next();
  ChromaMatte estimator;
  Matte found, wish;
  Agreement agreement;
  while (const auto frame = video->next()) {
    if (frame->number % 12 != 0) continue;
    truth->estimate(*frame, wish);
    estimator.estimate(report::before_screen(*frame, *clean, wish), found);
    if (frame->number < 24) continue;
    agreement.add(found, wish);
  }
  EXPECT_GT(agreement.iou(), 0.97);
  EXPECT_GT(agreement.boundary_f3(), 0.95);
}

// Half a pixel of red before green.
TEST(ChromaMatte, SoftEdgeKeepsItsShareAndLosesTheScreen) {
  const int width = 320, height = 180;
  const int screen[] = {120, 80, 70}, thing[] = {100, 110, 200};
  Frame frame = test::plain_frame(width, height, screen[0], screen[1], screen[2]);
  for (std::size_t p = 0; p < 3; ++p) {
    const int step = p == 0 ? 1 : 2;
    for (int y = 40 / step; y < 140 / step; ++y) {
      std::uint8_t* row = frame.planes[p].data + y * frame.planes[p].stride_bytes;
      std::fill(row + 100 / step, row + 200 / step, static_cast<std::uint8_t>(thing[p]));
      // Two columns, so that they are a column of chroma.
      std::fill(row + 98 / step, row + 100 / step, static_cast<std::uint8_t>((thing[p] + screen[p]) / 2));
    }
  }
  ChromaMatte estimator;
  Matte found;
  estimator.estimate(frame, found);
  EXPECT_EQ(found.alpha[90u * width + 20], 0);
  EXPECT_EQ(found.alpha[90u * width + 150], 255);
  // Chroma is interpolated between its samples, by an eighth of the step at most to either side.
  const int edge = (found.alpha[90u * width + 98] + found.alpha[90u * width + 99]) / 2;
  EXPECT_NEAR(edge, 127, 40);
  // At least a third of what the screen adds to the filmed colour is gone; all would be, were alpha exactly a half.
  PictureReader reader;
  const cv::Matx34f rgb_from_ycc = reader.read(frame).rgb_from_ycc;
  const cv::Vec3f red = to_rgb(rgb_from_ycc, {100, 110, 200}), filmed = to_rgb(rgb_from_ycc, {110, 95, 135});
  const std::uint8_t* own = &found.own_rgb[3 * (90u * width + 99)];
  for (int c = 0; c < 2; ++c) {
    EXPECT_LT(std::abs(static_cast<float>(own[c]) - red[c]), 2.f / 3 * std::abs(filmed[c] - red[c]));
  }
}

TEST(ChromaMatte, ScreenWithoutColourIsRefused) {
  ChromaMatte estimator;
  Matte found;
  const Frame grey = test::plain_frame(320, 180, 120, 128, 128);
  EXPECT_NE(test::error_of(Error::Kind::Input, [&] { estimator.estimate(grey, found); }).find("key = "),
            std::string::npos);
}

TEST(ChromaMatte, ManBeforeTheYellowWallIsWhole) {
  RINKAKU_NEEDS_DATA();
  const auto video = source::open(test::data("recordings/clips/mdn_chromakey_person.mp4").string());
  ChromaMatte estimator;
  Matte found;
  for (int i = 0; i < 5; ++i) estimator.estimate(*video->next(), found);
  const cv::Mat alpha = test::alpha_of(found);
  // Above and beside his head nothing, in his face and shirt everything.
  EXPECT_EQ(cv::countNonZero(alpha(cv::Rect(5, 5, 70, 60))), 0);
  EXPECT_EQ(cv::countNonZero(alpha(cv::Rect(240, 5, 70, 60))), 0);
  EXPECT_EQ(cv::countNonZero(alpha(cv::Rect(120, 60, 50, 60)) < 250), 0);
  EXPECT_EQ(cv::countNonZero(alpha(cv::Rect(80, 160, 140, 25)) < 250), 0);
}

}  // namespace
}  // namespace rinkaku::matte
