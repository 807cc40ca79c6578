#include "pipeline/matte/crop_box.h"

#include <gtest/gtest.h>

namespace rinkaku::matte {
namespace {

const cv::Size whole(1280, 720);

bool holds(const PixelRect& box, const PixelRect& thing) { return intersection(box, thing) == thing; }

TEST(CropBox, HoldsTheThingAndStaysInThePicture) {
  for (const PixelRect& thing :
       {PixelRect{600, 200, 120, 400}, {0, 0, 50, 40}, {1180, 500, 100, 220}, {10, 5, 1260, 700}}) {
    CropBox box;
    box.begin(thing, whole);
    EXPECT_TRUE(holds(box.rect(), thing)) << thing.x_px;
    EXPECT_TRUE(holds({0, 0, whole.width, whole.height}, box.rect())) << thing.x_px;
  }
}

// A network's pixels are square if the box has the shape of its input.
TEST(CropBox, IsUprightForWhatStands) {
  CropBox box;
  box.begin({600, 200, 120, 400}, whole);
  EXPECT_NEAR(static_cast<double>(box.rect().width_px) / box.rect().height_px, 9.0 / 16, 0.01);  // whole pixels
  box.begin({300, 400, 400, 120}, whole);
  EXPECT_NEAR(static_cast<double>(box.rect().width_px) / box.rect().height_px, 16.0 / 9, 0.03);
}

// Twelve pixels a frame is a walk across a 720p picture in under two seconds.
TEST(CropBox, KeepsUpWithSomebodyWalking) {
  CropBox box;
  PixelRect thing{100, 200, 120, 400};
  box.begin(thing, whole);
  for (int frame = 0; frame < 80; ++frame) {
    box.follow(intersection(thing, box.rect()));
    thing.x_px += 12;
    EXPECT_TRUE(holds(box.rect(), thing)) << "frame " << frame;
    EXPECT_LT(box.rect().width_px, 420) << "frame " << frame;  // upright: 480 * 9 / 16 = 270, and what lags inwards
  }
}

// What is seen touches the box: the box grows until it has the whole.
TEST(CropBox, GrowsAroundWhatItCuts) {
  CropBox box;
  const PixelRect thing{500, 60, 200, 600};
  box.begin({560, 60, 80, 150}, whole);
  for (int frame = 0; frame < 20; ++frame) box.follow(intersection(thing, box.rect()));
  EXPECT_TRUE(holds(box.rect(), thing));
}

}  // namespace
}  // namespace rinkaku::matte
