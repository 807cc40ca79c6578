#include "pipeline/passes/composite/lens_map.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

#include "pipeline/frame/error.h"

namespace rinkaku::test {
namespace {

using passes::Layer;
using passes::LensMap;
using passes::PixelRect;

CameraModel camera(double focal_px, std::array<double, 14> distortion) {
  CameraModel c;
  c.width_px = 320, c.height_px = 240;
  c.fx_px = focal_px, c.fy_px = focal_px * 1.01;
  c.cx_px = 163.2, c.cy_px = 117.7;
  c.distortion = distortion;
  return c;
}

// A webcam's barrel, a zoom's pincushion, and the rational model of a wide lens.
CameraModel barrel() { return camera(260, {-0.28, 0.09, 0.0012, -0.0008, -0.01}); }
CameraModel pincushion() { return camera(330, {0.21, -0.11, -0.0009, 0.0015, 0.05}); }
CameraModel rational() { return camera(210, {0.9, 0.12, 0.0004, 0.0003, 0.01, 1.22, 0.35, 0.03}); }
// Grows only up to the normalised radius 0.816, seen at 0.544: 109 pixels from the centre.
CameraModel folding() { return camera(200, {-0.5}); }

std::vector<double> coefficients(const CameraModel& c) { return {c.distortion.begin(), c.distortion.end()}; }

cv::Matx33d camera_matrix(const CameraModel& c) { return {c.fx_px, 0, c.cx_px, 0, c.fy_px, c.cy_px, 0, 0, 1}; }

// Where each plate pixel lies in the pinhole picture, by OpenCV's own inverse.
std::vector<cv::Point2d> undistorted_by_opencv(const CameraModel& c) {
  std::vector<cv::Point2d> pixels, straight;
  for (int y = 0; y < c.height_px; ++y) {
    for (int x = 0; x < c.width_px; ++x) pixels.emplace_back(x, y);
  }
  cv::undistortPoints(pixels, straight, camera_matrix(c), coefficients(c), cv::noArray(), camera_matrix(c),
                      cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 500, 1e-9));
  return straight;
}

Layer empty_layer(const PixelRect& rect) {
  return {rect, std::vector<std::uint8_t>(static_cast<std::size_t>(rect.width_px) * rect.height_px * 4)};
}

// A disc, its edge antialiased by 8x8 samples a pixel.
Layer disc_layer(const PixelRect& rect, cv::Point2d centre, double radius) {
  Layer layer = empty_layer(rect);
  for (int y = 0; y < rect.height_px; ++y) {
    for (int x = 0; x < rect.width_px; ++x) {
      int inside = 0;
      for (int s = 0; s < 64; ++s) {
        const double sx = rect.x_px + x + (s % 8 - 3.5) / 8, sy = rect.y_px + y + (s / 8 - 3.5) / 8;
        if (std::hypot(sx - centre.x, sy - centre.y) < radius) ++inside;
      }
      for (int c = 0; c < 4; ++c) {
        layer.rgba[(static_cast<std::size_t>(y) * rect.width_px + x) * 4 + c] =
            static_cast<std::uint8_t>(std::lround(inside * 255 / 64.0));
      }
    }
  }
  return layer;
}

cv::Point2d centroid(const Layer& layer) {
  double sum = 0, x_sum = 0, y_sum = 0;
  for (int y = 0; y < layer.rect.height_px; ++y) {
    for (int x = 0; x < layer.rect.width_px; ++x) {
      const double a = layer.rgba[(static_cast<std::size_t>(y) * layer.rect.width_px + x) * 4 + 3];
      sum += a, x_sum += a * (layer.rect.x_px + x), y_sum += a * (layer.rect.y_px + y);
    }
  }
  return {x_sum / sum, y_sum / sum};
}

TEST(LensMap, DiscLandsWhereOpenCVProjectsItsCentre) {
  for (const CameraModel& c : {barrel(), pincushion(), rational()}) {
    const LensMap lens(c);
    Layer plate;
    for (double ny : {-0.36, -0.1, 0.2, 0.34}) {
      for (double nx : {-0.42, -0.2, 0.05, 0.4}) {
        std::vector<cv::Point2d> seen;
        cv::projectPoints(std::vector<cv::Point3d>{{nx, ny, 1}}, cv::Vec3d(), cv::Vec3d(), camera_matrix(c),
                          coefficients(c), seen);
        if (seen[0].x < 8 || seen[0].y < 8 || seen[0].x > c.width_px - 9 || seen[0].y > c.height_px - 9) continue;
        const cv::Point2d centre(c.fx_px * nx + c.cx_px, c.fy_px * ny + c.cy_px);
        const PixelRect rect{static_cast<int>(centre.x) - 8, static_cast<int>(centre.y) - 8, 17, 17};
        lens.distort(disc_layer(rect, centre, 3), plate);
        const cv::Point2d found = centroid(plate);
        // Lookups are on a grid of 1/32 pixel; that a disc's middle is not the image of its middle is second order:
        // 0.02 pixels at this radius.
        EXPECT_NEAR(found.x, seen[0].x, 0.05) << nx << ", " << ny;
        EXPECT_NEAR(found.y, seen[0].y, 0.05) << nx << ", " << ny;
      }
    }
  }
}

// Smooth waves: no pixel differs from its neighbours by more than 8 code values.
int wave(double x, double y, int channel) {
  return static_cast<int>(std::lround(127.5 + 110 * std::sin(0.05 * x + channel) * std::cos(0.05 * y - channel)));
}

TEST(LensMap, AgreesWithOpenCVsUndistortedPointsAtEveryPixel) {
  for (const CameraModel& c : {barrel(), pincushion(), rational()}) {
    const LensMap lens(c);
    Layer pinhole = empty_layer(lens.pinhole_rect());
    for (int y = 0; y < pinhole.rect.height_px; ++y) {
      for (int x = 0; x < pinhole.rect.width_px; ++x) {
        for (int k = 0; k < 4; ++k) {
          pinhole.rgba[(static_cast<std::size_t>(y) * pinhole.rect.width_px + x) * 4 + k] =
              static_cast<std::uint8_t>(k == 3 ? 255 : wave(x + pinhole.rect.x_px, y + pinhole.rect.y_px, k));
        }
      }
    }
    Layer plate;
    lens.distort(pinhole, plate);
    ASSERT_EQ(plate.rect, (PixelRect{0, 0, c.width_px, c.height_px}));
    const std::vector<cv::Point2d> straight = undistorted_by_opencv(c);
    for (std::size_t i = 0; i < straight.size(); ++i) {
      ASSERT_EQ(plate.rgba[4 * i + 3], 255) << i;  // the pinhole picture reaches under every pixel of the plate
      for (int k = 0; k < 3; ++k) {
        // 1/64 pixel of lookup at 8 code values a pixel, twice rounding (the layer's and the result's), and 0.1 for the
        // wave's curvature between pixels.
        ASSERT_NEAR(plate.rgba[4 * i + k], wave(straight[i].x, straight[i].y, k), 1.5)
            << i % c.width_px << ", " << i / c.width_px;
      }
    }
  }
}

TEST(LensMap, PlateRectHoldsEverythingThatIsSeenOfARectangle) {
  std::mt19937 random(5);
  for (const CameraModel& c : {barrel(), pincushion(), rational(), folding()}) {
    const LensMap lens(c);
    const PixelRect all = lens.pinhole_rect();
    Layer whole = empty_layer(all), plate_whole;
    for (int i = 0; i < 60; ++i) {
      PixelRect rect{all.x_px + static_cast<int>(random() % all.width_px),
                     all.y_px + static_cast<int>(random() % all.height_px), 0, 0};
      rect.width_px = 1 + static_cast<int>(random() % (all.right_px() - rect.x_px));
      rect.height_px = 1 + static_cast<int>(random() % (all.bottom_px() - rect.y_px));
      // Through the map of the whole picture every pixel is looked up, so nothing can be cut off.
      std::fill(whole.rgba.begin(), whole.rgba.end(), std::uint8_t{0});
      Layer part = empty_layer(rect), plate_part;
      std::fill(part.rgba.begin(), part.rgba.end(), std::uint8_t{255});
      for (int y = rect.y_px; y < rect.bottom_px(); ++y) {
        std::fill_n(whole.rgba.begin() + ((y - all.y_px) * all.width_px + rect.x_px - all.x_px) * 4, rect.width_px * 4,
                    std::uint8_t{255});
      }
      lens.distort(whole, plate_whole);
      lens.distort(part, plate_part);
      const PixelRect seen = plate_part.rect;
      ASSERT_EQ(seen, lens.plate_rect(rect));
      ASSERT_EQ(seen, intersection(seen, {0, 0, c.width_px, c.height_px}));
      for (int y = 0; y < plate_whole.rect.height_px; ++y) {
        for (int x = 0; x < plate_whole.rect.width_px; ++x) {
          const int px = x + plate_whole.rect.x_px, py = y + plate_whole.rect.y_px;
          const int wish = plate_whole.rgba[(y * plate_whole.rect.width_px + x) * 4 + 3];
          const bool inside = px >= seen.x_px && py >= seen.y_px && px < seen.right_px() && py < seen.bottom_px();
          const int is = inside ? plate_part.rgba[((py - seen.y_px) * seen.width_px + px - seen.x_px) * 4 + 3] : 0;
          ASSERT_EQ(is, wish) << px << ", " << py << " of " << rect.x_px << "," << rect.y_px << " " << rect.width_px
                              << "x" << rect.height_px;
        }
      }
    }
  }
}

TEST(LensMap, PlateRectIsNotMuchLargerThanNeeded) {
  const LensMap lens(barrel());
  const PixelRect seen = lens.plate_rect({150, 100, 30, 20});
  // Near the centre the lens hardly shrinks; 3 pixels are added on each side, and rounding takes up to one.
  EXPECT_LE(seen.width_px, 30 + 8);
  EXPECT_LE(seen.height_px, 20 + 8);
}

TEST(LensMap, OfNothingIsNothing) {
  const LensMap lens(barrel());
  Layer plate = empty_layer({0, 0, 5, 5});
  lens.distort(Layer{}, plate);
  EXPECT_TRUE(plate.rect.empty());
  lens.distort(empty_layer({100000, 0, 3, 3}), plate);
  EXPECT_TRUE(plate.rect.empty());
}

TEST(LensMap, TinyDistortionIsTheIdentity) {
  const CameraModel c = camera(300, {1e-9});
  const LensMap lens(c);
  std::mt19937 random(6);
  Layer pinhole = empty_layer({17, 31, 101, 77}), plate;
  for (std::uint8_t& v : pinhole.rgba) v = static_cast<std::uint8_t>(random());
  lens.distort(pinhole, plate);
  for (int y = 0; y < plate.rect.height_px; ++y) {
    for (int x = 0; x < plate.rect.width_px; ++x) {
      const int lx = x + plate.rect.x_px - 17, ly = y + plate.rect.y_px - 31;
      const bool inside = lx >= 0 && ly >= 0 && lx < 101 && ly < 77;
      for (int k = 0; k < 4; ++k) {
        ASSERT_EQ(plate.rgba[(y * plate.rect.width_px + x) * 4 + k],
                  inside ? pinhole.rgba[(ly * 101 + lx) * 4 + k] : 0);
      }
    }
  }
}

TEST(LensMap, LeavesPixelsPastTheFoldTransparent) {
  const CameraModel c = folding();
  const LensMap lens(c);
  Layer pinhole = empty_layer(lens.pinhole_rect()), plate;
  std::fill(pinhole.rgba.begin(), pinhole.rgba.end(), std::uint8_t{255});
  lens.distort(pinhole, plate);
  // d/dr (r - r^3 / 2) = 0 at r^2 = 2/3, where r - r^3 / 2 = 0.5443.
  const double fold = 0.54433;
  for (int y = 0; y < c.height_px; ++y) {
    for (int x = 0; x < c.width_px; ++x) {
      const int lx = x - plate.rect.x_px, ly = y - plate.rect.y_px;
      const bool inside = lx >= 0 && ly >= 0 && lx < plate.rect.width_px && ly < plate.rect.height_px;
      const int alpha = inside ? plate.rgba[(ly * plate.rect.width_px + lx) * 4 + 3] : 0;
      const double r = std::hypot((x - c.cx_px) / c.fx_px, (y - c.cy_px) / c.fy_px);
      // One pixel (0.005) around the fold, where the lens's slope is nearly 0, may be either.
      if (std::abs(r - fold) < 0.005) continue;
      ASSERT_EQ(alpha, r < fold ? 255 : 0) << x << ", " << y;
    }
  }
}

TEST(LensMap, RefusesALensThatBendsThePictureTooFar) {
  // Never folds, and far out six pixels of the pinhole picture are seen as one: r (1 + r^2 / 2) / (1 + 3 r^2).
  EXPECT_THROW(LensMap(camera(40, {0.5, 0, 0, 0, 0, 3})), Error);
}

// A principal point far outside with a folding lens: no pixel of the plate shows anything.
TEST(LensMap, RefusesALensThroughWhichNothingIsSeen) {
  CameraModel c = folding();
  c.cx_px = -4000;
  EXPECT_THROW(LensMap{c}, Error);
}

}  // namespace
}  // namespace rinkaku::test
