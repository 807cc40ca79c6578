#include "pipeline/matte/thing_line.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace rinkaku::matte {
namespace {

// Takes the teeth out of a matte's edge, as a pen does, and gives alpha a slope where the edge is hard.
constexpr double blur_px = 1.2;
// So far the line goes on within the shape, so that the filmed background doesn't shine between it and what is opaque:
// motion makes edges as soft as this.
constexpr float within_px = 8;

// Sets pixels of `mask` that belong to pieces of fewer than `least_px` pixels to `value`.
void overwrite_small(const cv::Mat& pieces, int connectivity, int least_px, std::uint8_t value, cv::Mat& mask,
                     cv::Mat& labels, cv::Mat& stats, cv::Mat& centres) {
  const int count = cv::connectedComponentsWithStats(pieces, labels, stats, centres, connectivity);
  for (int i = 1; i < count; ++i) {
    if (stats.at<int>(i, cv::CC_STAT_AREA) >= least_px) continue;
    const cv::Rect box(stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                       stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT));
    for (int y = box.y; y < box.y + box.height; ++y) {
      const int* label = labels.ptr<int>(y);
      std::uint8_t* out = mask.ptr<std::uint8_t>(y);
      for (int x = box.x; x < box.x + box.width; ++x) {
        if (label[x] == i) out[x] = value;
      }
    }
  }
}

}  // namespace

ThingLine::ThingLine(const ThingLineOptions& options) : options_(options) {}

// The shape whose contour the line follows, in matte.line_rect.
void ThingLine::find_shape(const Matte& matte) {
  const PixelRect& rect = matte.line_rect;
  const cv::Mat alpha(matte.height_px, matte.width_px, CV_8U, const_cast<std::uint8_t*>(matte.alpha.data()));
  const cv::Mat part = alpha(cv::Rect(rect.x_px, rect.y_px, rect.width_px, rect.height_px));
  part.convertTo(blurred_, CV_32F);
  cv::GaussianBlur(blurred_, blurred_, {}, blur_px, blur_px, cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  cv::compare(blurred_, 127.5, shape_, cv::CMP_GT);
  const int least_px = static_cast<int>(std::min(4 * options_.width_px * options_.width_px, 1600.0)) + 9;
  overwrite_small(shape_, 8, 4 * least_px, 0, shape_, labels_, stats_, centres_);
  cv::bitwise_not(shape_, outside_);
  overwrite_small(outside_, 4, least_px, 255, shape_, labels_, stats_, centres_);
}

// Where the contour lies, seen from each pixel of the shape.
void ThingLine::find_contour(int width_px, int height_px) {
  sources_.assign(1, {});  // labels count from 1
  for (int y = 0; y < height_px; ++y) {
    const auto* inside = shape_.ptr<std::uint8_t>(y);
    const float* value = blurred_.ptr<float>(y);
    const float *above = blurred_.ptr<float>(std::max(y - 1, 0)),
                *below = blurred_.ptr<float>(std::min(y + 1, height_px - 1));
    for (int x = 0; x < width_px; ++x) {
      if (inside[x] == 0) continue;
      const float dx = 0.5f * (value[std::min(x + 1, width_px - 1)] - value[std::max(x - 1, 0)]);
      const float dy = 0.5f * (below[x] - above[x]);
      const float slope = std::max(std::hypot(dx, dy), 1.0f);
      sources_.push_back(
          {static_cast<float>(x), static_cast<float>(y), std::clamp((value[x] - 127.5f) / slope, 0.0f, 1.0f)});
    }
  }
}

float ThingLine::away(int label, int x, int y) const {
  const Source& source = sources_[static_cast<std::size_t>(label)];
  return std::hypot(static_cast<float>(x) - source.x, static_cast<float>(y) - source.y) - source.beyond;
}

// The pixel of the shape whose centre is nearest need not be the one whose contour is: neighbours' are tried, once from
// above and once from below.
void ThingLine::find_nearest(float reach_px) {
  const auto look = [&](int x, int y, int dx, int dy) {
    const int nx = x + dx, ny = y + dy;
    if (nx < 0 || ny < 0 || nx >= labels_.cols || ny >= labels_.rows) return;
    int& own = labels_.at<int>(y, x);
    const int other = labels_.at<int>(ny, nx);
    if (other != own && away(other, x, y) < away(own, x, y)) own = other;
  };
  const auto visit = [&](int x, int y, int back) {
    if (shape_.at<std::uint8_t>(y, x) != 0 || distance_.at<float>(y, x) > reach_px) return;
    for (int dx = -1; dx <= 1; ++dx) look(x, y, dx, -back);
    look(x, y, -back, 0);
  };
  for (int y = 0; y < labels_.rows; ++y) {
    for (int x = 0; x < labels_.cols; ++x) visit(x, y, 1);
  }
  for (int y = labels_.rows - 1; y >= 0; --y) {
    for (int x = labels_.cols - 1; x >= 0; --x) visit(x, y, -1);
  }
}

void ThingLine::draw(Matte& matte) {
  matte.line_rect = {};
  matte.line.clear();
  if (matte.rect.empty()) return;
  const auto width = static_cast<float>(options_.width_px);
  const int around = static_cast<int>(std::ceil(width)) + 4;
  matte.line_rect = intersection({matte.rect.x_px - around, matte.rect.y_px - around, matte.rect.width_px + 2 * around,
                                  matte.rect.height_px + 2 * around},
                                 {0, 0, matte.width_px, matte.height_px});
  const PixelRect& rect = matte.line_rect;
  for (std::size_t c = 0; c < 3; ++c) {
    matte.line_rgb[c] = static_cast<std::uint8_t>(std::lround(options_.colour[c] * 255));
  }
  matte.line.assign(static_cast<std::size_t>(rect.width_px) * rect.height_px, 0);
  find_shape(matte);
  if (cv::countNonZero(shape_) == 0) return;
  find_contour(rect.width_px, rect.height_px);

  const auto coverage = [](float pixels) {
    return static_cast<std::uint8_t>(std::clamp(pixels, 0.0f, 1.0f) * 255 + 0.5f);
  };
  cv::distanceTransform(shape_, distance_, cv::DIST_L2, cv::DIST_MASK_3);  // within: it need not be exact
  for (int y = 0; y < rect.height_px; ++y) {
    const auto* inside = shape_.ptr<std::uint8_t>(y);
    const float* depth = distance_.ptr<float>(y);
    std::uint8_t* out = matte.line.data() + static_cast<std::size_t>(y) * rect.width_px;
    for (int x = 0; x < rect.width_px; ++x) {
      if (inside[x] == 0 || depth[x] > within_px + 1) continue;
      const float alpha = static_cast<float>(matte.alpha_row(rect.y_px + y)[rect.x_px + x]) / 255;
      out[x] = coverage(std::min(within_px + 0.5f - depth[x], 2 * alpha));  // not over pinholes
    }
  }
  cv::bitwise_not(shape_, outside_);
  cv::distanceTransform(outside_, distance_, labels_, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
  find_nearest(width + 3);
  for (int y = 0; y < rect.height_px; ++y) {
    const auto* inside = shape_.ptr<std::uint8_t>(y);
    const float* near = distance_.ptr<float>(y);
    const int* label = labels_.ptr<int>(y);
    std::uint8_t* out = matte.line.data() + static_cast<std::size_t>(y) * rect.width_px;
    for (int x = 0; x < rect.width_px; ++x) {
      if (inside[x] != 0 || near[x] > width + 3) continue;
      out[x] = coverage(width + 0.5f - away(label[x], x, y));
    }
  }
}

}  // namespace rinkaku::matte
