#include "pipeline/source/v4l2/modes.h"

#include <linux/videodev2.h>

#include <gtest/gtest.h>

namespace rinkaku::source::v4l2 {
namespace {

constexpr FourCc yuyv = V4L2_PIX_FMT_YUYV, mjpg = V4L2_PIX_FMT_MJPEG, bayer = V4L2_PIX_FMT_SBGGR8;

// As a common webcam has them: raw pictures are slow where they are large.
const std::vector<Mode> webcam = {{yuyv, 640, 480, {{30, 1}, {15, 1}}}, {yuyv, 1280, 720, {{10, 1}, {5, 1}}},
                                  {mjpg, 640, 480, {{30, 1}}},          {mjpg, 1280, 720, {{30, 1}}},
                                  {mjpg, 1920, 1080, {{30, 1}}},        {bayer, 1280, 720, {{60, 1}}}};

void expect(const ModeWish& wish, FourCc format, int width, int height, std::int64_t rate) {
  const auto choice = best_choice(webcam, wish);
  ASSERT_TRUE(choice);
  EXPECT_EQ(name_of(choice->format), name_of(format));
  EXPECT_EQ(choice->width_px, width);
  EXPECT_EQ(choice->height_px, height);
  EXPECT_EQ(choice->rate.num, rate);
}

TEST(CameraModes, WithoutAWishItIsFluentAndNotTooLarge) { expect({}, mjpg, 1280, 720, 30); }

TEST(CameraModes, UncompressedComesFirstWhereItIsAsFast) {
  expect({.width_px = 640, .height_px = 480}, yuyv, 640, 480, 30);
}

TEST(CameraModes, WishedFormatIsKept) {
  expect({.format = yuyv, .width_px = 1280, .height_px = 720}, yuyv, 1280, 720, 10);
}

TEST(CameraModes, WishedRateDecidesBetweenFormats) {
  expect({.width_px = 1280, .height_px = 720, .rate = {10, 1}}, yuyv, 1280, 720, 10);
}

TEST(CameraModes, NearestSizeIsTaken) { expect({.width_px = 1900, .height_px = 1000}, mjpg, 1920, 1080, 30); }

TEST(CameraModes, UnreadableFormatsAreNeverChosen) {
  EXPECT_FALSE(best_choice({webcam.back()}, {}));
  EXPECT_FALSE(best_choice(webcam, {.format = V4L2_PIX_FMT_NV12}));
}

TEST(CameraModes, FormatsHaveTwoNames) {
  EXPECT_EQ(format_named("yuyv"), yuyv);
  EXPECT_EQ(format_named("yuyv422"), yuyv);
  EXPECT_EQ(format_named("MJPG"), mjpg);
  EXPECT_EQ(format_named("BA81"), 0u);
}

TEST(CameraColour, IsWhatTheDriverSaysOrV4l2Implies) {
  v4l2_pix_format format{};
  format.pixelformat = yuyv;
  format.colorspace = V4L2_COLORSPACE_SRGB;  // as webcams say; V4L2's table: BT.601 matrix, limited range
  EXPECT_EQ(colour_of(format), (ColourTags{1, 13, 6, ColourTags::Range::Limited, 1}));
  format.colorspace = V4L2_COLORSPACE_REC709;
  EXPECT_EQ(colour_of(format), (ColourTags{1, 1, 1, ColourTags::Range::Limited, 1}));
  format.colorspace = V4L2_COLORSPACE_JPEG;
  EXPECT_EQ(colour_of(format), (ColourTags{1, 13, 6, ColourTags::Range::Full, 1}));
  format.colorspace = V4L2_COLORSPACE_SMPTE170M;
  format.quantization = V4L2_QUANTIZATION_FULL_RANGE;
  EXPECT_EQ(colour_of(format), (ColourTags{6, 1, 6, ColourTags::Range::Full, 1}));
  format.colorspace = V4L2_COLORSPACE_DEFAULT;
  EXPECT_EQ(colour_of(format), ColourTags{});
}

TEST(CameraIdentity, SerialNumberWinsOverPlace) {
  const Identity wanted{"Cam", "usb-1", "A"};
  EXPECT_EQ(likeness(wanted, {"Cam", "usb-2", "B"}), 0);  // another one of the same kind
  EXPECT_GT(likeness(wanted, {"Cam", "usb-1", "A"}), likeness(wanted, {"Cam", "usb-2", "A"}));
  EXPECT_EQ(likeness(wanted, {"Other", "usb-1", "A"}), 0);
  const Identity plain{"Cam", "usb-1", ""};
  EXPECT_GT(likeness(plain, {"Cam", "usb-1", ""}), likeness(plain, {"Cam", "usb-2", ""}));
  EXPECT_GT(likeness(plain, {"Cam", "usb-2", ""}), 0);  // plugged in elsewhere
}

}  // namespace
}  // namespace rinkaku::source::v4l2
