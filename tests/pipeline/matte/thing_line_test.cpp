#include "pipeline/matte/thing_line.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "pipeline/matte/estimator.h"

namespace rinkaku::matte {
namespace {

constexpr int width = 200, height = 160;

Matte matte_of(const std::function<double(double x, double y)>& alpha) {
  Matte matte;
  matte.width_px = width, matte.height_px = height;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      matte.alpha.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(alpha(x, y), 0.0, 1.0))));
    }
  }
  find_rect(matte);
  return matte;
}

double line_at(const Matte& matte, int x, int y) {
  const PixelRect& r = matte.line_rect;
  if (x < r.x_px || y < r.y_px || x >= r.right_px() || y >= r.bottom_px()) return 0;
  return matte.line[static_cast<std::size_t>(y - r.y_px) * r.width_px + x - r.x_px] / 255.0;
}

// Of a disk whose middle is on no pixel, the line outside is a ring: its width is known along each row and column to a
// fraction of a pixel, and its area exactly.
TEST(ThingLine, IsARingOfItsWidthAroundADisk) {
  for (const double wide : {1.0, 2.5, 6.0}) {
    const double radius = 40.3, middle_x = 99.7, middle_y = 80.2;
    const auto away = [&](double x, double y) { return std::hypot(x - middle_x, y - middle_y) - radius; };
    Matte matte = matte_of([&](double x, double y) { return 0.5 - away(x, y); });
    ThingLine({.width_px = wide}).draw(matte);
    double area = 0, worst = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double d = away(x, y);
        if (d < 1) continue;
        area += line_at(matte, x, y);
        worst = std::max(worst, std::abs(line_at(matte, x, y) - std::clamp(wide + 0.5 - d, 0.0, 1.0)));
      }
    }
    // The blur moves a contour of this radius inwards by sigma^2 / (2 r), a fiftieth of a pixel; the nearest pixel's
    // slope adds a tenth where it is slanting.
    EXPECT_LT(worst, 0.2) << wide;
    const double outer = radius + std::max(wide, 1.0), inner = radius + 1;
    if (wide > 1) {
      EXPECT_NEAR(area / (M_PI * (outer * outer - inner * inner)), 1, 0.08) << wide;
    }
  }
}

TEST(ThingLine, IsAsWideAtAHardEdgeAndNoneAtThePicturesBorder) {
  Matte matte = matte_of([](double x, double y) { return x < 50 && y < 100 ? 1 : 0; });
  ThingLine({.width_px = 3}).draw(matte);
  for (int y = 0; y < 90; ++y) {
    double across = 0;
    for (int x = 50; x < width; ++x) across += line_at(matte, x, y);
    EXPECT_NEAR(across, 3, 0.1) << y;
    EXPECT_EQ(line_at(matte, 10, y), 0) << y;
  }
  EXPECT_EQ(line_at(matte, 0, 0), 0);
  // Round a corner.
  EXPECT_EQ(line_at(matte, 54, 104), 0);
}

TEST(ThingLine, SpecksAndPinholesHaveNone) {
  Matte matte = matte_of([](double x, double y) {
    const bool body = x > 40 && x < 120 && y > 40 && y < 120;
    return (body && std::hypot(x - 80, y - 80) > 3) || std::hypot(x - 150, y - 80) < 3 ? 1 : 0;
  });
  ThingLine({.width_px = 3}).draw(matte);
  EXPECT_EQ(line_at(matte, 80, 80), 0);
  EXPECT_EQ(line_at(matte, 145, 80), 0);
  EXPECT_EQ(line_at(matte, 38, 80), 1);
}

TEST(ThingLine, NothingHasNone) {
  Matte matte = matte_of([](double, double) { return 0; });
  ThingLine({}).draw(matte);
  EXPECT_TRUE(matte.line_rect.empty());
  EXPECT_TRUE(matte.line.empty());
}

}  // namespace
}  // namespace rinkaku::matte
