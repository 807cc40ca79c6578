#include "pipeline/passes/view.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

namespace rinkaku::test {
namespace {

using passes::clip_from_camera;
using passes::PixelRect;

CameraModel camera() {
  CameraModel c;
  c.width_px = 1281, c.height_px = 719;
  c.fx_px = 913.5, c.fy_px = 921.25, c.cx_px = 644.1, c.cy_px = 351.9;
  return c;
}

// Window position to pixel, by GL's rule: pixel i's centre lies at i + 0.5 from the viewport's edge.
glm::dvec2 pixel_of(const glm::dvec4& clip, const PixelRect& rect) {
  return {rect.x_px + (clip.x / clip.w + 1) / 2 * rect.width_px - 0.5,
          rect.y_px + (clip.y / clip.w + 1) / 2 * rect.height_px - 0.5};
}

TEST(ClipFromCamera, ProjectsAsOpenCVDoes) {
  const CameraModel c = camera();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> across(-1, 1), log_depth(std::log(0.01), std::log(5000.0));
  std::vector<cv::Point3d> points;
  for (int i = 0; i < 500; ++i) {
    const double z = std::exp(log_depth(random));
    points.emplace_back(across(random) * z, across(random) * z, z);
  }
  std::vector<cv::Point2d> seen;
  cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), cv::Matx33d(c.fx_px, 0, c.cx_px, 0, c.fy_px, c.cy_px, 0, 0, 1),
                    cv::noArray(), seen);
  for (const PixelRect& rect : {PixelRect{0, 0, 1281, 719}, PixelRect{-40, 17, 333, 101}, PixelRect{700, 300, 1, 1}}) {
    const glm::dmat4 m = clip_from_camera(c, rect);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const glm::dvec4 clip = m * glm::dvec4(points[i].x, points[i].y, points[i].z, 1);
      const glm::dvec2 pixel = pixel_of(clip, rect);
      // All in double: only its rounding, some 1e-13 of a coordinate of up to 2000.
      ASSERT_NEAR(pixel.x, seen[i].x, 1e-8);
      ASSERT_NEAR(pixel.y, seen[i].y, 1e-8);
      ASSERT_EQ(clip.w, points[i].z);
    }
  }
}

TEST(ClipFromCamera, RectanglesCornersAreClipSpacesCorners) {
  const CameraModel c = camera();
  const PixelRect rect{100, 50, 200, 80};
  const glm::dmat4 m = clip_from_camera(c, rect);
  auto clip_of_pixel = [&](double x, double y) {
    const glm::dvec2 n = to_normalised(c, {x, y});
    return m * glm::dvec4(n, 1, 1);
  };
  EXPECT_NEAR(clip_of_pixel(99.5, 49.5).x, -1, 1e-12);
  EXPECT_NEAR(clip_of_pixel(99.5, 49.5).y, -1, 1e-12);  // the top row is at window y = 0
  EXPECT_NEAR(clip_of_pixel(299.5, 129.5).x, 1, 1e-12);
  EXPECT_NEAR(clip_of_pixel(299.5, 129.5).y, 1, 1e-12);
}

float depth_at(double z_m) {
  const glm::dvec4 clip = clip_from_camera(camera(), {0, 0, 640, 480}) * glm::dvec4(0, 0, z_m, 1);
  return static_cast<float>(clip.z) / static_cast<float>(clip.w);
}

TEST(ClipFromCamera, DepthIsOneAtTheNearPlaneAndNothingInfinitelyFar) {
  EXPECT_FLOAT_EQ(depth_at(passes::near_m), 1);
  EXPECT_GT(depth_at(1e9), 0);
  EXPECT_LT(depth_at(1e9), 1e-11f);
}

// How many floats lie between two depths: what a 32-bit float buffer tells apart.
std::int32_t floats_between(float a, float b) {
  std::int32_t i, j;
  std::memcpy(&i, &a, 4);
  std::memcpy(&j, &b, 4);
  return i - j;
}

TEST(ClipFromCamera, DepthTellsATenThousandthOfTheDistanceApartEverywhere) {
  for (double z : {0.002, 0.1, 1.0, 10.0, 1000.0, 20000.0}) {
    // Floats lie between 6e-8 and 1.2e-7 of their value apart; a depth itself is rounded to the nearest one.
    EXPECT_GE(floats_between(depth_at(z), depth_at(z * 1.0001)), 1e-4 / 1.2e-7 - 2) << z;
  }
  EXPECT_GT(depth_at(0.1), depth_at(0.1001));
  EXPECT_GT(depth_at(1000), depth_at(1000.1));
}

TEST(ClipFromCamera, DepthFallsMonotonically) {
  float last = 2;
  for (double z = passes::near_m; z < 5000; z *= 1.000001 + 1e-5) {
    const float depth = depth_at(z);
    ASSERT_LT(depth, last) << z;
    last = depth;
  }
}

}  // namespace
}  // namespace rinkaku::test
