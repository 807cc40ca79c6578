#include "water/verify/warping_error.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace rinkaku::test {
namespace {

using namespace water;

constexpr int size_px = 64;
constexpr double slope = 0.01;  // of brightness, a pixel

// Seen from straight above, 2 m high, with a focal length of 64 pixels: a metre takes 32 of them.
struct FromAbove {
  Surface surface{"test", {{{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}, {0, 1, 2, 3}, {}}, {0, 0, 2}};
  CameraModel camera{size_px, size_px, 64, 64, 31.5, 31.5, {}};
  RigidTransform camera_from_world{glm::angleAxis(std::numbers::pi, glm::dvec3(1, 0, 0)), {0, 0, 2}};

  // One arrow alone moves all water alike: 1.5 pixels a frame to the right.
  WarpingError error() const {
    ArrowKey key;
    key.arrows.push_back({surface.from_world({0, 0, 0}), surface.direction_from_world({1.5 / 32 * 25, 0, 0})});
    FlowOptions options;
    options.method = FlowOptions::Method::Arrows;
    Flow flow(surface, {key}, options);
    flow.set_frame(0);
    return WarpingError(flow, surface, camera, camera_from_world, 1.0 / 25);
  }
};

// A ramp whose zero lies at x = `shift_px`.
std::vector<glm::vec3> ramp(double shift_px) {
  std::vector<glm::vec3> picture;
  for (int y = 0; y < size_px; ++y) {
    for (int x = 0; x < size_px; ++x) picture.emplace_back(static_cast<float>(slope * (x - shift_px)));
  }
  return picture;
}

TEST(WarpingErrorTest, IsNothingForWhatMovesAsTheWaterDoes) {
  const WarpingError error = FromAbove().error();
  ASSERT_GT(error.pixels(), 50u * 50u);
  // Bilinear sampling is exact on a ramp: what is left is rounding of float.
  EXPECT_LT(error.between(ramp(0), ramp(1.5)), 1e-12);
}

TEST(WarpingErrorTest, IsTheSquareOfWhatIsAmiss) {
  const WarpingError error = FromAbove().error();
  const double expected = std::pow(1.5 * slope, 2);
  // Rounding of float.
  EXPECT_NEAR(error.between(ramp(0), ramp(0)), expected, 1e-4 * expected);
  EXPECT_NEAR(error.between(ramp(0), ramp(3)), expected, 1e-4 * expected);
}

TEST(WarpingErrorTest, ContrastIsTheStandardDeviation) {
  const WarpingError error = FromAbove().error();
  EXPECT_EQ(error.contrast(std::vector<glm::vec3>(size_px * size_px, glm::vec3(0.25f))), 0);
  std::vector<glm::vec3> halves = ramp(0);
  for (std::size_t i = 0; i < halves.size(); ++i) halves[i] = glm::vec3(i % 2 == 0 ? 0.0f : 1.0f);
  // Half of the pixels each, but for a column at most: 54 or 55 of them.
  EXPECT_NEAR(error.contrast(halves), 0.5, 1e-3);
}

}  // namespace
}  // namespace rinkaku::test
