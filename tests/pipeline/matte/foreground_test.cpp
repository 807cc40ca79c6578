#include "pipeline/matte/foreground.h"

#include "pipeline/frame/error.h"
#include "pipeline/matte/own_colour.h"
#include "tests/pipeline/matte/matte_tools.h"

namespace rinkaku::matte {
namespace {

// Mattes of one value in each of four columns.
class Columns : public MatteEstimator {
 public:
  explicit Columns(std::array<std::uint8_t, 4> values) : values_(values) {}
  const char* name() const override { return "columns"; }
  void estimate(const Frame& frame, Matte& matte) override {
    begin_matte(frame, matte);
    for (std::size_t i = 0; i < matte.alpha.size(); ++i) matte.alpha[i] = values_[i % 4];
    find_rect(matte);
  }

 private:
  std::array<std::uint8_t, 4> values_;
};

std::vector<int> combined(ForegroundOptions options) {
  std::vector<std::unique_ptr<MatteEstimator>> two;
  two.push_back(std::make_unique<Columns>(std::array<std::uint8_t, 4>{0, 100, 200, 255}));
  two.push_back(std::make_unique<Columns>(std::array<std::uint8_t, 4>{50, 10, 150, 0}));
  Foreground foreground(std::move(two), options);
  Matte matte;
  foreground.find(test::plain_frame(4, 2, 100, 128, 128, 7), matte);
  EXPECT_EQ(matte.frame_number, 7);
  return {matte.alpha[0], matte.alpha[1], matte.alpha[2], matte.alpha[3]};
}

TEST(Foreground, CombinesByLargestSmallestOrMostDecided) {
  using Combine = ForegroundOptions::Combine;
  EXPECT_EQ(combined({.combine = Combine::Maximum}), (std::vector<int>{50, 100, 200, 255}));
  EXPECT_EQ(combined({.combine = Combine::Minimum}), (std::vector<int>{0, 10, 150, 0}));
  EXPECT_EQ(combined({.combine = Combine::Confidence}), (std::vector<int>{0, 10, 200, 255}));
}

TEST(Foreground, NothingCountsOutsideOfTheRectangle) {
  std::vector<std::unique_ptr<MatteEstimator>> one;
  one.push_back(std::make_unique<Columns>(std::array<std::uint8_t, 4>{255, 255, 255, 255}));
  ForegroundOptions options;
  options.within = {3, 1, 4, 5};
  Foreground foreground(std::move(one), options);
  Matte matte;
  foreground.find(test::plain_frame(16, 8, 100, 128, 128), matte);
  EXPECT_EQ(matte.rect, *options.within);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      EXPECT_EQ(matte.alpha_row(y)[x], x >= 3 && x < 7 && y >= 1 && y < 6 ? 255 : 0);
    }
  }
}

TEST(FileMatte, TakesTheFramesOwnMatteByItsNumber) {
  int given = 0;
  FileMatte estimator("mattes", [&]() -> std::optional<Frame> {
    if (given == 6) return std::nullopt;
    Frame frame = test::plain_frame(8, 6, 16 + 20 * given, 128, 128, given);
    ++given;
    return frame;
  });
  Matte matte;
  estimator.estimate(test::plain_frame(8, 6, 50, 128, 128, 3), matte);
  EXPECT_EQ(matte.frame_number, 3);
  EXPECT_EQ(matte.alpha[0], std::lround(60 * 255 / 219.0));  // limited range
  estimator.estimate(test::plain_frame(8, 6, 50, 128, 128, 4), matte);
  EXPECT_EQ(matte.alpha[0], std::lround(80 * 255 / 219.0));
  const std::string line =
      test::error_of(Error::Kind::Input, [&] { estimator.estimate(test::plain_frame(8, 6, 50, 128, 128, 9), matte); });
  EXPECT_EQ(line, "mattes: the mattes end before frame 9 of the plate; give one matte for each frame");
}

TEST(FileMatte, OtherSizesAreRefused) {
  FileMatte estimator("mattes", [] { return std::optional(test::plain_frame(8, 6, 16, 128, 128)); });
  Matte matte;
  EXPECT_EQ(
      test::error_of(Error::Kind::Input, [&] { estimator.estimate(test::plain_frame(16, 6, 50, 128, 128), matte); }),
      "mattes: the mattes are 8x6 and the plate is 16x6; give mattes of the plate's size");
}

// Mattes go round, from thing to thing: one without a line must not keep another's.
TEST(Mattes, BegunAnewHaveNoLine) {
  Matte matte;
  matte.line_rect = {1, 2, 3, 4};
  matte.line.assign(12, 255);
  begin_matte(test::plain_frame(16, 8, 50, 128, 128), matte);
  EXPECT_TRUE(matte.line_rect.empty());
  EXPECT_TRUE(matte.line.empty());
}

// A blue thing before orange, its edge two pixels wide: without knowing the background.
TEST(OwnColours, AreThoseOfTheThingAlongItsSoftEdge) {
  const int width = 160, height = 90;
  Frame frame = test::plain_frame(width, height, 150, 80, 180);
  Matte matte;
  begin_matte(frame, matte);
  const int thing[] = {60, 190, 100};
  for (std::size_t p = 0; p < 3; ++p) {
    const int step = p == 0 ? 1 : 2;
    for (int y = 20 / step; y < 70 / step; ++y) {
      std::uint8_t* row = frame.planes[p].data + y * frame.planes[p].stride_bytes;
      for (int x = 48; x < 120; x += step) {
        const int there = row[x / step];
        row[x / step] = static_cast<std::uint8_t>(x < 50 ? (there + thing[p]) / 2 : thing[p]);
      }
    }
  }
  for (int y = 20; y < 70; ++y) {
    for (int x = 48; x < 120; ++x) matte.alpha_row(y)[x] = x < 50 ? 128 : 255;
  }
  find_rect(matte);
  PictureReader reader;
  const Picture& picture = reader.read(frame);
  OwnColours().find(picture, matte);
  const cv::Vec3f wish = to_rgb(picture.rgb_from_ycc, {60, 190, 100});
  for (int y = 30; y < 60; ++y) {
    // Means over the surroundings are a few levels off; what was filmed is 90 to 130 off.
    for (int c = 0; c < 3; ++c) {
      const float expected = std::clamp(wish[c], 0.f, 255.f);
      EXPECT_NEAR(matte.own_rgb[static_cast<std::size_t>((y * width + 48) * 3 + c)], expected, 12) << y << " " << c;
    }
  }
}

}  // namespace
}  // namespace rinkaku::matte
