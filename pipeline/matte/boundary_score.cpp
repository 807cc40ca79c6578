#include "pipeline/matte/boundary_score.h"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace rinkaku::matte {
namespace {

cv::Mat boundary(const cv::Mat& inside) {
  cv::Mat out = cv::Mat::zeros(inside.size(), CV_8U);
  for (int y = 0; y < inside.rows; ++y) {
    const int below = std::min(y + 1, inside.rows - 1);
    for (int x = 0; x < inside.cols; ++x) {
      const int right = std::min(x + 1, inside.cols - 1);
      const bool here = inside.at<std::uint8_t>(y, x) != 0;
      const auto differs = [&](int row, int column) { return (inside.at<std::uint8_t>(row, column) != 0) != here; };
      if (differs(y, right) || differs(below, x) || differs(below, right)) out.at<std::uint8_t>(y, x) = 255;
    }
  }
  return out;
}

cv::Mat disk(int radius_px) {
  const int side = 2 * radius_px + 1;
  cv::Mat out(side, side, CV_8U);
  for (int y = -radius_px; y <= radius_px; ++y) {
    for (int x = -radius_px; x <= radius_px; ++x) {
      out.at<std::uint8_t>(y + radius_px, x + radius_px) = x * x + y * y <= radius_px * radius_px ? 1 : 0;
    }
  }
  return out;
}

// The part of `of` that lies within the disk around some pixel of `near`.
double matched(const cv::Mat& of, const cv::Mat& near, const cv::Mat& within) {
  cv::Mat reached;
  cv::dilate(near, reached, within);
  return static_cast<double>(cv::countNonZero(of & reached)) / cv::countNonZero(of);
}

}  // namespace

double boundary_f(const cv::Mat& found, const cv::Mat& truth, int tolerance_px) {
  const cv::Mat found_edge = boundary(found), true_edge = boundary(truth);
  const bool none_found = cv::countNonZero(found_edge) == 0, none_true = cv::countNonZero(true_edge) == 0;
  if (none_found || none_true) return none_found && none_true ? 1 : 0;
  const cv::Mat within = disk(tolerance_px);
  const double precision = matched(found_edge, true_edge, within), recall = matched(true_edge, found_edge, within);
  return precision + recall > 0 ? 2 * precision * recall / (precision + recall) : 0;
}

}  // namespace rinkaku::matte
