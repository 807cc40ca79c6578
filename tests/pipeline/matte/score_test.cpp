#include "pipeline/matte/score.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace rinkaku {
namespace {

using matte::GreyMatte;
using matte::Score;

GreyMatte picture(int width_px, int height_px, const std::function<float(int x, int y)>& alpha) {
  GreyMatte out{width_px, height_px, {}};
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) out.alpha.push_back(alpha(x, y));
  }
  return out;
}

GreyMatte square(int left, int right, int top = 2, int bottom = 6) {
  return picture(8, 8, [=](int x, int y) { return x >= left && x < right && y >= top && y < bottom ? 1.0f : 0.0f; });
}

GreyMatte noise(int width_px, int height_px, unsigned seed) {
  std::mt19937 engine(seed);
  return picture(width_px, height_px, [&](int, int) { return static_cast<float>(engine() % 256) / 255; });
}

TEST(MatteScore, EqualMattesAreFaultless) {
  const GreyMatte m = noise(23, 17, 1);
  const Score s = matte::score(m, m);
  EXPECT_EQ(s.mismatch_px, 0);
  EXPECT_EQ(s.iou, 1);
  EXPECT_EQ(s.sad, 0);
  EXPECT_EQ(s.mse, 0);
  EXPECT_EQ(s.grad, 0);
  EXPECT_EQ(s.conn, 0);
  EXPECT_EQ(s.boundary_f1, 1);
  EXPECT_EQ(s.boundary_f3, 1);
}

TEST(MatteScore, ShiftedSquareByHand) {
  // Two columns of four pixels differ; 12 of 20 pixels are in both.
  const Score s = matte::score(square(3, 7), square(2, 6));
  EXPECT_EQ(s.mismatch_px, 8);
  EXPECT_DOUBLE_EQ(s.iou, 12.0 / 20);
  EXPECT_DOUBLE_EQ(s.sad, 8);
  EXPECT_DOUBLE_EQ(s.mse, 8.0 / 64);
  // Where only one has the square, its alpha of 1 hangs on nothing that both share: 0 against 1.
  EXPECT_DOUBLE_EQ(s.conn, 8);
  EXPECT_GT(s.grad, 0);
  EXPECT_DOUBLE_EQ(s.boundary_f1, 1) << "every boundary pixel has one of the other within a pixel";
}

TEST(MatteScore, EmptyMattesAgreeAndOneEmptyOneDoesNot) {
  const GreyMatte none = square(0, 0);
  EXPECT_EQ(matte::score(none, none).iou, 1);
  EXPECT_EQ(matte::score(none, none).boundary_f1, 1);
  EXPECT_EQ(matte::score(none, square(2, 6)).iou, 0);
  EXPECT_EQ(matte::score(none, square(2, 6)).boundary_f3, 0);
  EXPECT_EQ(matte::score(square(2, 6), none).boundary_f3, 0);
}

TEST(MatteScore, EvenTransparencyByHand) {
  const GreyMatte thin = picture(5, 4, [](int, int) { return 0.55f; });
  const GreyMatte solid = picture(5, 4, [](int, int) { return 1.0f; });
  const Score s = matte::score(thin, solid);
  EXPECT_EQ(s.mismatch_px, 20);
  EXPECT_EQ(s.iou, 1);
  EXPECT_NEAR(s.sad, 20 * 0.45, 1e-5) << "0.55 is no float";
  EXPECT_NEAR(s.mse, 0.45 * 0.45, 1e-6);
  EXPECT_NEAR(s.grad, 0, 1e-9);
  // Both hang together up to 0.5. 0.55 is less than theta above it and counts as connected, 1 is 0.5 above it.
  EXPECT_NEAR(s.conn, 20 * 0.5, 1e-5);
}

TEST(MatteScore, ConnectivityOfALonePixelByHand) {
  const auto with_pixel = [](float alpha) {
    GreyMatte m = square(0, 4, 0, 4);
    m.alpha[7 * 8 + 7] = alpha;
    return m;
  };
  // It hangs on nothing at any level. 0.1 is below theta: connectedness 1; of 0.3 it is 0.7.
  EXPECT_NEAR(matte::score(with_pixel(0.3f), with_pixel(0.1f)).conn, 0.3, 1e-6);
  // Touching the square by a corner does not connect it: neighbours are four.
  GreyMatte corner = square(0, 4, 0, 4), thin_corner = corner;
  corner.alpha[4 * 8 + 4] = 1;
  thin_corner.alpha[4 * 8 + 4] = 0.5f;
  EXPECT_NEAR(matte::score(corner, thin_corner).conn, 0.5, 1e-6);
}

// The filter as the paper has it: two-dimensional kernels, normalised as a whole, borders repeated.
std::vector<double> gradient_by_definition(const GreyMatte& m) {
  constexpr double sigma = 1.4;
  constexpr int half = 4;  // ceil(1.4 sqrt(-2 ln(sqrt(2 pi) 1.4 0.01)))
  const auto gauss = [](double x) { return std::exp(-x * x / (2 * sigma * sigma)) / (sigma * std::sqrt(2 * M_PI)); };
  const auto derivative = [&](double x) { return -x * gauss(x) / (sigma * sigma); };
  double energy = 0;
  for (int v = -half; v <= half; ++v) {
    for (int u = -half; u <= half; ++u) energy += std::pow(derivative(u) * gauss(v), 2);
  }
  std::vector<double> lengths;
  for (int y = 0; y < m.height_px; ++y) {
    for (int x = 0; x < m.width_px; ++x) {
      double gx = 0, gy = 0;
      for (int v = -half; v <= half; ++v) {
        for (int u = -half; u <= half; ++u) {
          const int column = std::clamp(x + u, 0, m.width_px - 1), row = std::clamp(y + v, 0, m.height_px - 1);
          const double alpha = m.alpha[static_cast<std::size_t>(row * m.width_px + column)];
          gx += alpha * derivative(u) * gauss(v);
          gy += alpha * derivative(v) * gauss(u);
        }
      }
      lengths.push_back(std::hypot(gx, gy) / std::sqrt(energy));
    }
  }
  return lengths;
}

TEST(MatteScore, GradientErrorFollowsItsDefinition) {
  const GreyMatte m = noise(19, 13, 2), t = noise(19, 13, 3);
  const std::vector<double> of_m = gradient_by_definition(m), of_t = gradient_by_definition(t);
  double expected = 0;
  for (std::size_t i = 0; i < of_m.size(); ++i) expected += std::pow(of_m[i] - of_t[i], 2);
  EXPECT_NEAR(matte::score(m, t).grad, expected, 1e-9 * expected) << "same sums in another order, in double";
}

TEST(MatteScore, BoundaryMeasureByHand) {
  const auto left_of = [](int upper, int lower) {
    return picture(8, 8, [=](int x, int y) { return x < (y < 4 ? upper : lower) ? 1.0f : 0.0f; });
  };
  // Two pixels apart everywhere.
  EXPECT_EQ(matte::score(left_of(6, 6), left_of(4, 4)).boundary_f1, 0);
  EXPECT_EQ(matte::score(left_of(6, 6), left_of(4, 4)).boundary_f3, 1);
  // A step in the middle: of its 10 boundary pixels 6 are near the true line, of whose 8 pixels 6 are near it.
  EXPECT_DOUBLE_EQ(matte::score(left_of(6, 4), left_of(4, 4)).boundary_f1, 2 * 0.6 * 0.75 / (0.6 + 0.75));
}

TEST(MatteScore, FlickerIsWhatChangesOtherwiseThanTheTruth) {
  const auto even = [](float value) { return picture(4, 4, [=](int, int) { return value; }); };
  EXPECT_EQ(matte::flicker(even(0.25f), even(0.25f), even(0), even(0)), 0) << "always off by the same";
  EXPECT_EQ(matte::flicker(even(0.25f), even(0.75f), even(0), even(0.5f)), 0) << "changes as the truth does";
  EXPECT_EQ(matte::flicker(even(0.25f), even(0.75f), even(0), even(0)), 0.5);
  // Half of the pixels change by 0.5: the root of 0.25 / 2.
  const GreyMatte half = picture(4, 4, [](int x, int) { return x < 2 ? 0.5f : 0.0f; });
  EXPECT_DOUBLE_EQ(matte::flicker(even(0), half, even(0), even(0)), std::sqrt(0.125));
}

}  // namespace
}  // namespace rinkaku
