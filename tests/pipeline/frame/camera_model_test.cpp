#include "pipeline/frame/camera_model.h"

#include <cmath>
#include <limits>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

namespace rinkaku {
namespace {

CameraModel camera(std::initializer_list<double> distortion) {
  CameraModel model{1280, 720, 900, 910, 650, 350, {}};
  std::copy(distortion.begin(), distortion.end(), model.distortion.begin());
  return model;
}

// Lenses as calibrations find them: barrel, pincushion, tangential, rational, thin prism, a real one.
const std::vector<CameraModel>& lenses() {
  static const std::vector<CameraModel> all = {
      camera({}),
      camera({-0.3, 0.1, 0, 0, -0.02}),
      camera({0.2, 0.05, 0, 0, 0}),
      camera({-0.2, 0.05, 0.003, -0.004, 0.01}),
      camera({0.5, 0.1, 0.001, 0.001, 0.01, 0.8, 0.2, 0.03}),
      camera({-0.1, 0.02, 0.001, -0.002, 0, 0, 0, 0, 0.004, -0.001, -0.003, 0.002}),
      camera({0.0995485, -0.206384, 0.00754589, 0.00336531, 0}),
  };
  return all;
}

cv::Mat coefficients(const CameraModel& model) {
  return cv::Mat(1, 12, CV_64F, const_cast<double*>(model.distortion.data())).clone();
}

TEST(CameraModel, ProjectsAsOpenCvDoes) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> across(-0.7, 0.7), deep(1, 5);
  for (const CameraModel& model : lenses()) {
    const cv::Matx33d matrix(model.fx_px, 0, model.cx_px, 0, model.fy_px, model.cy_px, 0, 0, 1);
    std::vector<cv::Point3d> points;
    for (int i = 0; i < 200; ++i) {
      const double z = deep(random);
      points.emplace_back(across(random) * z, across(random) * z, z);
    }
    std::vector<cv::Point2d> seen;
    cv::projectPoints(points, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0), matrix, coefficients(model), seen);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const glm::dvec2 px = to_pixels(model, distort(model, {points[i].x / points[i].z, points[i].y / points[i].z}));
      ASSERT_NEAR(px.x, seen[i].x, 1e-9);
      ASSERT_NEAR(px.y, seen[i].y, 1e-9);
    }
  }
}

TEST(CameraModel, UndistortsWhatItDistorted) {
  for (const CameraModel& model : lenses()) {
    const double limit = max_undistorted_radius(model);
    for (double y = -0.45; y <= 0.45; y += 0.09) {
      for (double x = -0.75; x <= 0.75; x += 0.09) {
        const glm::dvec2 p(x, y);
        if (glm::length(p) > 0.95 * limit) continue;
        const auto back = undistort(model, distort(model, p), limit);
        ASSERT_TRUE(back) << x << " " << y << " k1 " << model.distortion[0];
        ASSERT_NEAR(glm::distance(*back, p), 0, 1e-9) << x << " " << y << " k1 " << model.distortion[0];
      }
    }
  }
}

TEST(CameraModel, UndistortsAsOpenCvDoes) {
  for (const CameraModel& model : lenses()) {
    const double limit = max_undistorted_radius(model);
    const cv::Matx33d matrix(model.fx_px, 0, model.cx_px, 0, model.fy_px, model.cy_px, 0, 0, 1);
    std::vector<cv::Point2d> pixels, expected;
    for (int y = 90; y < 720; y += 90) {
      for (int x = 160; x < 1280; x += 160) pixels.emplace_back(x, y);
    }
    cv::undistortPoints(pixels, expected, matrix, coefficients(model), cv::noArray(), cv::noArray(),
                        cv::TermCriteria(cv::TermCriteria::MAX_ITER + cv::TermCriteria::EPS, 500, 1e-13));
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const auto p = undistort(model, to_normalised(model, {pixels[i].x, pixels[i].y}), limit);
      if (!p) continue;  // beyond the fold: OpenCV gives some number there
      // OpenCV iterates to a fixed point, which converges slowly in strong distortion.
      ASSERT_NEAR(p->x, expected[i].x, 1e-7) << pixels[i];
      ASSERT_NEAR(p->y, expected[i].y, 1e-7) << pixels[i];
    }
  }
}

TEST(CameraModel, FindsWhereALensFolds) {
  // r (1 + k1 r^2) turns back where 1 + 3 k1 r^2 = 0.
  const CameraModel barrel = camera({-0.25});
  EXPECT_NEAR(max_undistorted_radius(barrel), std::sqrt(1 / 0.75), 0.006);
  EXPECT_EQ(max_undistorted_radius(camera({})), std::numeric_limits<double>::infinity());
  EXPECT_EQ(max_undistorted_radius(camera({0.2})), std::numeric_limits<double>::infinity());
  // Tangential distortion alone does not fold radially.
  EXPECT_EQ(max_undistorted_radius(camera({0, 0, 0.001, 0.001})), std::numeric_limits<double>::infinity());
}

TEST(CameraModel, SeesNothingBeyondTheFold) {
  const CameraModel barrel = camera({-0.25});
  const double limit = max_undistorted_radius(barrel);
  // The distorted radius r (1 - r^2 / 4) is largest, 2/3 r, at r = sqrt(4/3).
  const double edge = std::sqrt(4.0 / 3) * 2 / 3;
  for (double angle = 0; angle < 6.28; angle += 0.1) {
    const glm::dvec2 direction(std::cos(angle), std::sin(angle));
    EXPECT_FALSE(undistort(barrel, direction * (edge + 0.001), limit)) << angle;
    EXPECT_FALSE(undistort(barrel, direction * 5.0, limit)) << angle;
    const auto inside = undistort(barrel, direction * (edge - 0.001), limit);
    ASSERT_TRUE(inside) << angle;
    EXPECT_LE(glm::length(*inside), limit);
    EXPECT_NEAR(glm::distance(distort(barrel, *inside), direction * (edge - 0.001)), 0, 1e-9);
  }
}

TEST(CameraModel, StaysFiniteOrEmptyForAnyInput) {
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::nan("");
  for (const CameraModel& model : lenses()) {
    if (!model.has_distortion()) continue;
    const double limit = max_undistorted_radius(model);
    for (const double v : {0.0, 1e-300, 1e3, 1e30, 1e300, infinity, nan}) {
      const auto p = undistort(model, {v, -v}, limit);
      if (p) {
        EXPECT_TRUE(std::isfinite(p->x) && std::isfinite(p->y)) << v;
      }
    }
    EXPECT_EQ(*undistort(model, {0, 0}, limit), glm::dvec2(0, 0));
  }
}

TEST(CameraModel, PutsPixelsAndNormalisedCoordinatesToAndFro) {
  const CameraModel model = camera({});
  EXPECT_EQ(to_pixels(model, {0, 0}), glm::dvec2(650, 350));
  EXPECT_EQ(to_normalised(model, {650 + 900, 350 - 910}), glm::dvec2(1, -1));
}

}  // namespace
}  // namespace rinkaku
