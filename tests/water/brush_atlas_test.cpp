#include "water/brush_atlas.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace rinkaku::test {
namespace {

using water::BrushAtlas;
using water::BrushSheet;

const std::uint8_t* texel(const BrushAtlas& atlas, int x, int y) {
  return atlas.texels.data() + (static_cast<std::size_t>(y) * atlas.width_px + x) * 4;
}

TEST(BrushAtlas, HoldsTheSheetAndHalvesThatHaveAsMuchPaint) {
  const BrushSheet sheet = water::line_brushes();
  const BrushAtlas atlas = water::brush_atlas(sheet);
  ASSERT_EQ(atlas.levels.size(), 4u);  // 32, 16, 8 and 4 rows
  for (int number = 0; number < sheet.layers; ++number) {
    double whole = 0;
    for (const BrushAtlas::Level& level : atlas.levels) {
      double sum = 0;
      for (int y = 0; y < level.height_px; ++y) {
        for (int x = 0; x < level.width_px; ++x) {
          const int paint = texel(atlas, level.left_px + number * level.step_px + x, level.top_px + y)[0];
          sum += paint;
          if (&level != &atlas.levels.front()) continue;
          const std::size_t i = (static_cast<std::size_t>(number) * sheet.height_px + y) * sheet.width_px + x;
          ASSERT_EQ(paint, sheet.texels[2 * i]);
        }
      }
      const double mean = sum / (level.width_px * level.height_px);
      if (&level == &atlas.levels.front()) whole = mean;
      // Each texel is rounded, by up to a half.
      EXPECT_NEAR(mean, whole, 0.5) << "brush " << number << ", " << level.height_px << " rows";
    }
  }
}

TEST(BrushAtlas, HasNoPaintAroundItsBrushes) {
  const BrushSheet sheet = water::drop_brushes();
  const BrushAtlas atlas = water::brush_atlas(sheet);
  std::vector<char> inside(static_cast<std::size_t>(atlas.width_px) * atlas.height_px, 0);
  for (const BrushAtlas::Level& level : atlas.levels) {
    for (int number = 0; number < sheet.layers; ++number) {
      const int left = level.left_px + number * level.step_px;
      // A texel's room on each side, not shared by two brushes' paint.
      ASSERT_GE(left, 1);
      ASSERT_LT(left + level.width_px, atlas.width_px);
      ASSERT_LT(level.top_px + level.height_px, atlas.height_px);
      for (int y = 0; y < level.height_px; ++y) {
        for (int x = 0; x < level.width_px; ++x) {
          char& here = inside[static_cast<std::size_t>(level.top_px + y) * atlas.width_px + left + x];
          ASSERT_EQ(here, 0);
          here = 1;
        }
      }
    }
  }
  for (int y = 0; y < atlas.height_px; ++y) {
    for (int x = 0; x < atlas.width_px; ++x) {
      if (!inside[static_cast<std::size_t>(y) * atlas.width_px + x]) {
        ASSERT_EQ(texel(atlas, x, y)[0], 0);
      }
    }
  }
}

TEST(BrushAtlas, GivesStrokesTexelsOfAboutAPixel) {
  const BrushAtlas atlas = water::brush_atlas(water::line_brushes());
  for (float width = 3; width < 40; width *= 1.1f) {
    const BrushAtlas::Level& level = atlas.level_for(4 * width, width);
    const float texel_px = width / static_cast<float>(level.height_px);
    if (level.height_px > 4) {
      EXPECT_GE(texel_px, 0.7f) << width;
    }
    // The next larger one would be too fine.
    if (level.height_px < 32) {
      EXPECT_LT(texel_px / 2, 0.7f) << width;
    }
  }
  // Wide and short: not finer along than twice that.
  EXPECT_LT(atlas.level_for(20, 30).height_px, 32);
}

}  // namespace
}  // namespace rinkaku::test
