#include "pipeline/matte/segmentation.h"

#include <filesystem>

#include <opencv2/imgproc.hpp>

#include "pipeline/frame/error.h"
#include "pipeline/matte/refinement.h"
#include "tests/pipeline/matte/matte_tools.h"
#include "tests/support/environment.h"

namespace rinkaku::matte {
namespace {

// Stands in for the network: what is bright is a person, if it is large enough in what is looked at, as of networks.
struct BrightIsSomebody {
  int* looks;
  void operator()(const Picture& picture, const PixelRect& part, cv::Mat& likely) const {
    ++*looks;
    cv::Mat small;
    const cv::Rect rect(part.x_px, part.y_px, part.width_px, part.height_px);
    cv::resize(picture.luma(rect), small, {144, 144}, 0, 0, cv::INTER_AREA);
    likely = cv::Mat::zeros(small.size(), CV_32F);
    cv::Mat bright = small > 120;
    if (cv::boundingRect(bright).height < 48) return;  // a third of what is seen
    likely.setTo(1, bright);
  }
};

Frame with_person(const PixelRect& person, std::int64_t number) {
  Frame frame = test::plain_frame(1280, 720, 40, 128, 128, number);
  for (int y = person.y_px; y < person.bottom_px(); ++y) {
    std::fill_n(frame.planes[0].data + y * frame.planes[0].stride_bytes + person.x_px, person.width_px,
                std::uint8_t{200});
  }
  return frame;
}

double agreement(const Matte& found, const PixelRect& person) {
  cv::Mat wish = cv::Mat::zeros(found.height_px, found.width_px, CV_8U);
  wish(cv::Rect(person.x_px, person.y_px, person.width_px, person.height_px)).setTo(255);
  const cv::Mat inside = test::alpha_of(found) > 127;
  return static_cast<double>(cv::countNonZero(inside & wish)) / cv::countNonZero(inside | wish);
}

// 140 pixels of 720 are too few for the network in the whole picture, but not in a part of half its size.
TEST(SegmentationMatte, FindsASmallPersonAtOnceAndFollows) {
  int looks = 0;
  SegmentationMatte estimator{BrightIsSomebody{&looks}};
  Matte found;
  PixelRect person{150, 420, 56, 140};
  for (int number = 0; number < 60; ++number) {
    looks = 0;
    estimator.estimate(with_person(person, number), found);
    EXPECT_EQ(found.frame_number, number);
    // A grid of 144 in a box of some 170 pixels: borders are known to about a pixel, of 56 x 140.
    EXPECT_GT(agreement(found, person), 0.93) << "frame " << number;
    if (number > 0) {
      EXPECT_EQ(looks, 1) << "frame " << number;
    }
    person.x_px += 8;
  }
}

TEST(SegmentationMatte, LosesAndFindsAgain) {
  int looks = 0;
  SegmentationMatte estimator{BrightIsSomebody{&looks}};
  Matte found;
  const PixelRect first{100, 300, 90, 240}, second{1000, 200, 70, 160}, nobody{};
  estimator.estimate(with_person(first, 0), found);
  EXPECT_FALSE(found.rect.empty());
  estimator.estimate(with_person(nobody, 1), found);
  EXPECT_TRUE(found.rect.empty());
  EXPECT_EQ(cv::countNonZero(test::alpha_of(found)), 0);
  int frames = 0;
  do {
    looks = 0;
    estimator.estimate(with_person(second, 2 + frames), found);
    EXPECT_LE(looks, 3);  // one part in each frame, beside the whole; and the box around what was found
    ++frames;
  } while (found.rect.empty() && frames < 20);
  EXPECT_LE(frames, 9);  // as many as there are parts
  EXPECT_GT(agreement(found, second), 0.9);
}

TEST(SegmentationMatte, SmallPicturesAreNoTrouble) {
  int looks = 0;
  SegmentationMatte estimator{BrightIsSomebody{&looks}};
  Matte found;
  estimator.estimate(test::plain_frame(2, 2, 40, 128, 128), found);
  EXPECT_TRUE(found.rect.empty());
}

// A matte whose border is 3 pixels off, one of the network's, and soft, comes to lie on the plate's own.
TEST(Refinement, MovesBordersToThePlates) {
  const PixelRect person{400, 200, 300, 400};
  const Frame frame = with_person(person, 0);
  PictureReader reader;
  Matte matte;
  begin_matte(frame, matte);
  cv::Mat alpha = test::alpha_of(matte);
  alpha(cv::Rect(403, 203, 300, 400)).setTo(255);
  cv::GaussianBlur(alpha, alpha, {0, 0}, 4);
  find_rect(matte);
  const double before = agreement(matte, person);
  Refinement().refine(reader.read(frame), matte);
  EXPECT_LT(before, 0.97);
  // Within half a pixel along 1,400 of border, of 120,000.
  EXPECT_GT(agreement(matte, person), 0.994);
  // What is far from any border is certain.
  EXPECT_EQ(matte.alpha_row(400)[550], 255);
  EXPECT_EQ(matte.alpha_row(400)[300], 0);
}

// The plate stands still but for a patch that moves; a matte that flickers is calmed in one and left alone in the
// other.
TEST(Refinement, IsSteadyWhereNothingMovesAndDoesNotLagWhereItDoes) {
  PictureReader reader;
  Refinement refinement;
  Matte matte;
  const auto refined = [&](const Frame& frame, const PixelRect& covered, int value) {
    begin_matte(frame, matte);
    cv::Mat alpha = test::alpha_of(matte);
    alpha(cv::Rect(covered.x_px, covered.y_px, covered.width_px, covered.height_px)).setTo(value);
    find_rect(matte);
    refinement.refine(reader.read(frame), matte);
  };
  const PixelRect still{100, 100, 200, 300};
  refined(with_person(still, 0), still, 200);
  const int first = matte.alpha_row(250)[200];
  refined(with_person(still, 1), still, 100);
  // Of a jump by 100 a third or so is left: 1 - 0.7, times the filter's gain.
  EXPECT_LT(std::abs(matte.alpha_row(250)[200] - first), 55);

  Refinement fresh;
  refinement = fresh;
  const PixelRect here{100, 100, 60, 300}, there{400, 100, 60, 300};
  refined(with_person(here, 0), here, 255);
  refined(with_person(there, 1), there, 255);
  EXPECT_GT(agreement(matte, there), 0.98);
  EXPECT_EQ(matte.alpha_row(250)[130], 0);  // nothing stays behind
}

class WithTheModel : public testing::Test {
 protected:
  void SetUp() override {
    try {
      model = installed_model();
    } catch (const Error&) {
      GTEST_SKIP() << "the model isn't installed: scripts/fetch-model";
    }
  }
  std::string model;
};

// A walker who was drawn, in a room that is wider than high: other people's network, and the recording's true matte.
TEST_F(WithTheModel, FindsTheWalkerAcrossAWideShot) {
  PersonNetwork network(model);
  SegmentationMatte estimator(
      [&](const Picture& picture, const PixelRect& part, cv::Mat& likely) { network.find(picture, part, likely); });
  const auto video = source::open(test::tripod + "video.mp4");
  const auto truth = test::file_matte(test::tripod + "matte.mkv");
  Matte found, wish;
  test::Agreement agreement;
  while (const auto frame = video->next()) {
    if (frame->number < 36) continue;  // the walker comes in
    if (frame->number > 70) break;
    estimator.estimate(*frame, found);
    truth->estimate(*frame, wish);
    agreement.add(found, wish);
    EXPECT_FALSE(found.rect.empty()) << "frame " << frame->number;
  }
  // The network leaves out the rucksack, about a tenth.
  EXPECT_GT(agreement.iou(), 0.75);
}

TEST(InstalledModel, WhereItIsAbsentTheMessageSaysHowToGetIt) {
  const test::Environment data("XDG_DATA_HOME", "/nonexistent");
  try {
    installed_model();
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_status(), 2);
    EXPECT_NE(std::string(error.what()).find("/nonexistent/rinkaku/models/selfie_segmentation.onnx"),
              std::string::npos);
    EXPECT_NE(std::string(error.what()).find("scripts/fetch-model"), std::string::npos);
  }
}

TEST(PersonNetwork, RefusesWhatIsNoModel) {
  try {
    PersonNetwork network(test::tripod + "scene.toml");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_status(), 2);
    EXPECT_NE(std::string(error.what()).find("scene.toml"), std::string::npos);
  }
}

}  // namespace
}  // namespace rinkaku::matte
