#include "pipeline/passes/composite/lens_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <opencv2/imgproc.hpp>

#include "pipeline/frame/error.h"

namespace rinkaku::passes {

struct LensMap::Tables {
  double max_radius = 0;
  PixelRect pinhole_rect;
  cv::Mat x_px;  // float, one a plate pixel: where it lies in the pinhole picture
  cv::Mat y_px;
  cv::Mat shifted_x, shifted_y;  // scratch
};

namespace {

// Far outside of any layer: cv::remap then writes nothing.
constexpr float nowhere = -1e6f;

}  // namespace

LensMap::LensMap(const CameraModel& camera) : camera_(camera), tables_(std::make_unique<Tables>()) {
  Tables& t = *tables_;
  t.max_radius = max_undistorted_radius(camera);
  t.x_px.create(camera.height_px, camera.width_px, CV_32F);
  t.y_px.create(camera.height_px, camera.width_px, CV_32F);
  double left = std::numeric_limits<double>::max(), top = left, right = -left, bottom = -left;
  for (int y = 0; y < camera.height_px; ++y) {
    float* row_x = t.x_px.ptr<float>(y);
    float* row_y = t.y_px.ptr<float>(y);
    for (int x = 0; x < camera.width_px; ++x) {
      const auto straight =
          undistort(camera, to_normalised(camera, {static_cast<double>(x), static_cast<double>(y)}), t.max_radius);
      if (!straight) {
        row_x[x] = row_y[x] = nowhere;
        continue;
      }
      const glm::dvec2 pixel = to_pixels(camera, *straight);
      row_x[x] = static_cast<float>(pixel.x);
      row_y[x] = static_cast<float>(pixel.y);
      left = std::min(left, pixel.x), right = std::max(right, pixel.x);
      top = std::min(top, pixel.y), bottom = std::max(bottom, pixel.y);
    }
  }
  if (right < left) {
    throw input_error("camera", "through its distortion no point of the picture is seen",
                      "check camera_matrix and distortion_coefficients");
  }
  if (!(right - left < 4.0 * camera.width_px && bottom - top < 4.0 * camera.height_px)) {
    throw input_error("camera", "its distortion bends the picture to over four times its size",
                      "calibrate again with more views near the corners, or with fewer coefficients");
  }
  // One pixel more on each side: lookups are bilinear.
  const int x0 = static_cast<int>(std::floor(left)) - 1, y0 = static_cast<int>(std::floor(top)) - 1;
  t.pinhole_rect = {x0, y0, static_cast<int>(std::ceil(right)) + 2 - x0, static_cast<int>(std::ceil(bottom)) + 2 - y0};
}

LensMap::~LensMap() = default;
LensMap::LensMap(LensMap&&) noexcept = default;

PixelRect LensMap::pinhole_rect() const { return tables_->pinhole_rect; }

PixelRect LensMap::plate_rect(const PixelRect& pinhole) const {
  if (pinhole.empty()) return {};
  double left = std::numeric_limits<double>::max(), top = left, right = -left, bottom = -left;
  auto visit = [&](double x, double y) {
    glm::dvec2 p = to_normalised(camera_, {x, y});
    // Points past the fold are seen at most where the fold is.
    const double r = std::hypot(p.x, p.y);
    if (r > tables_->max_radius) p *= tables_->max_radius / r;
    const glm::dvec2 seen = to_pixels(camera_, rinkaku::distort(camera_, p));
    left = std::min(left, seen.x), right = std::max(right, seen.x);
    top = std::min(top, seen.y), bottom = std::max(bottom, seen.y);
  };
  // Inside the fold the lens is one-to-one, so the border's image bounds the inside's. Between samples 8 pixels apart
  // the border bends by far less than the pixels added below.
  constexpr int step = 8;
  for (int x = pinhole.x_px - 1; x < pinhole.right_px() + step; x += step) {
    const int at = std::min(x, pinhole.right_px());
    visit(at, pinhole.y_px - 1);
    visit(at, pinhole.bottom_px());
  }
  for (int y = pinhole.y_px - 1; y < pinhole.bottom_px() + step; y += step) {
    const int at = std::min(y, pinhole.bottom_px());
    visit(pinhole.x_px - 1, at);
    visit(pinhole.right_px(), at);
  }
  constexpr int margin = 2;
  const double most = 1e6;
  const int x0 = static_cast<int>(std::clamp(std::floor(left), -most, most)) - margin;
  const int y0 = static_cast<int>(std::clamp(std::floor(top), -most, most)) - margin;
  const int x1 = static_cast<int>(std::clamp(std::ceil(right), -most, most)) + margin + 1;
  const int y1 = static_cast<int>(std::clamp(std::ceil(bottom), -most, most)) + margin + 1;
  return intersection({x0, y0, x1 - x0, y1 - y0}, {0, 0, camera_.width_px, camera_.height_px});
}

// Where the pixels of `plate` lie in `pinhole`.
void LensMap::shift(const PixelRect& plate, const PixelRect& pinhole) const {
  Tables& t = *tables_;
  const cv::Rect area(plate.x_px, plate.y_px, plate.width_px, plate.height_px);
  cv::subtract(t.x_px(area), cv::Scalar(pinhole.x_px), t.shifted_x);
  cv::subtract(t.y_px(area), cv::Scalar(pinhole.y_px), t.shifted_y);
}

void LensMap::distort(const Layer& pinhole, Layer& plate) const {
  plate.rect = plate_rect(pinhole.rect);
  plate.rgba.resize(static_cast<std::size_t>(plate.rect.width_px) * plate.rect.height_px * 4);
  if (plate.rect.empty()) return;
  shift(plate.rect, pinhole.rect);
  const cv::Mat from(pinhole.rect.height_px, pinhole.rect.width_px, CV_8UC4,
                     const_cast<std::uint8_t*>(pinhole.rgba.data()));
  cv::Mat to(plate.rect.height_px, plate.rect.width_px, CV_8UC4, plate.rgba.data());
  cv::remap(from, to, tables_->shifted_x, tables_->shifted_y, cv::INTER_LINEAR, cv::BORDER_CONSTANT,
            cv::Scalar::all(0));
}

void LensMap::distort(const DepthLayer& pinhole, DepthLayer& plate) const {
  plate.rect = plate_rect(pinhole.rect);
  plate.depth_m.resize(static_cast<std::size_t>(plate.rect.width_px) * plate.rect.height_px);
  if (plate.rect.empty()) return;
  shift(plate.rect, pinhole.rect);
  const cv::Mat from(pinhole.rect.height_px, pinhole.rect.width_px, CV_32F, const_cast<float*>(pinhole.depth_m.data()));
  cv::Mat to(plate.rect.height_px, plate.rect.width_px, CV_32F, plate.depth_m.data());
  cv::remap(from, to, tables_->shifted_x, tables_->shifted_y, cv::INTER_NEAREST, cv::BORDER_CONSTANT,
            cv::Scalar::all(0));
}

}  // namespace rinkaku::passes
