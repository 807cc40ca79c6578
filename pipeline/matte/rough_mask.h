#pragma once

#include <opencv2/core.hpp>

#include "pipeline/matte/light_field.h"

namespace rinkaku::matte {

/// Which pixels of a small picture are not the background under some gentle change of light.
class RoughMask {
 public:
  struct Options {
    float threshold = 2.5f;       ///< in units of what noise does
    float deepest_shadow = 0.6f;  ///< what is left of the light
    int least_px = 100;           ///< smaller pieces are dropped
    bool find_faint = false;      ///< also parts that hardly differ: of use if the background is known well
  };

  /// Both pictures CV_32FC3 of one size: luma above black, Cb and Cr from their middle. `light` follows.
  /// About 40 ns a pixel.
  void find(const cv::Mat& picture, const cv::Mat& background, LightField& light, const Options& options);

  const cv::Mat& mask() const { return mask_; }  ///< CV_8U, 0 or 255
  /// CV_32F: what the background's colours are to be multiplied by; inside the mask as it is around it.
  const cv::Mat& shade() const { return shade_; }

 private:
  void follow_light(const cv::Mat& picture, const cv::Mat& background, LightField& light);
  void measure(const cv::Mat& picture, const cv::Mat& background, const LightField& light, const Options& options);
  void find_faint(const cv::Mat& sure, const Options& options);
  void clean_up(const Options& options);
  void fill_shade();

  cv::Mat mask_, shade_;
  cv::Mat luma_, background_luma_, usable_, expected_, light_now_, light_then_;
  cv::Mat residual_, smooth_, texture_, distance_, labels_, stats_, centres_, weight_, weighted_, faint_;
};

}  // namespace rinkaku::matte
