#include "water/brushes.h"

#include <numeric>

#include <gtest/gtest.h>

namespace rinkaku::test {
namespace {

using water::BrushSheet;
using water::Picture;

TEST(OwnBrushes, HaveAsMuchPaintAsTheirPictureIsLightAndOpaque) {
  Picture grey;  // left half white, right half black
  grey.width_px = 256, grey.height_px = 64, grey.channels = 3;
  for (int i = 0; i < 256 * 64; ++i) {
    for (int c = 0; c < 3; ++c) grey.samples.push_back(i % 256 < 128 ? 255 : 0);
  }
  Picture half_opaque = grey;
  half_opaque.channels = 4;
  half_opaque.samples.clear();
  for (int i = 0; i < 256 * 64; ++i) half_opaque.samples.insert(half_opaque.samples.end(), {255, 255, 255, 128});
  const Picture pictures[] = {grey, half_opaque};
  const BrushSheet sheet = water::own_brushes(pictures);
  ASSERT_EQ(sheet.layers, 2);
  const auto paint = [&](int layer, int x, int y) {
    return int{sheet.texels[((static_cast<std::size_t>(layer) * sheet.height_px + y) * sheet.width_px + x) * 2]};
  };
  for (const int y : {0, sheet.height_px - 1}) {
    EXPECT_EQ(paint(0, 0, y), 255);
    EXPECT_EQ(paint(0, sheet.width_px / 2 - 1, y), 255);
    EXPECT_EQ(paint(0, sheet.width_px / 2, y), 0);
    EXPECT_EQ(paint(0, sheet.width_px - 1, y), 0);
    EXPECT_EQ(paint(1, 5, y), 128);
  }
}

TEST(OwnBrushes, AreSharedByInverseDistance) {
  const glm::dvec2 places[] = {{0, 0}, {3, 0}};
  // 1 m and 2 m away: two to one.
  EXPECT_EQ(water::brush_shares(places, {1, 0}), (std::array<std::uint8_t, 4>{170, 85, 0, 0}));
  EXPECT_EQ(water::brush_shares(places, {3, 0}), (std::array<std::uint8_t, 4>{0, 255, 0, 0}));
  const glm::dvec2 four[] = {{0, 0}, {3, 0}, {0, 5}, {-1, -1}};
  for (const glm::dvec2& at : {glm::dvec2(0.3, 0.2), glm::dvec2(100, 7), glm::dvec2(0, 0)}) {
    const auto shares = water::brush_shares(four, at);
    EXPECT_EQ(std::accumulate(shares.begin(), shares.end(), 0), 255);
  }
}

}  // namespace
}  // namespace rinkaku::test
