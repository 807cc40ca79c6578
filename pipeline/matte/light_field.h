#pragma once

#include <opencv2/core.hpp>

namespace rinkaku::matte {

/// How much brighter or darker a room has become since its background was taken, place by place: a gain for each cell
/// of a coarse grid, smoothed in space and followed in time, so that drifting daylight, exposure and broad shadows
/// aren't taken for things.
class LightField {
 public:
  /// Follows the light from `background` to `now`, both brightness above black (CV_32F, one size), where `usable`
  /// (CV_32F) is 1, not 0. Two passes over the picture.
  void follow(const cv::Mat& now, const cv::Mat& background, const cv::Mat& usable);

  /// The gain in each pixel of the size that follow() had; 1 before the first call.
  const cv::Mat& gain() const { return gain_; }

 private:
  cv::Mat cells_;  // CV_32F
  cv::Mat gain_;
  cv::Mat weighted_now_, weighted_background_, now_cells_, background_cells_;
};

}  // namespace rinkaku::matte
