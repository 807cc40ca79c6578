#pragma once

#include <opencv2/core.hpp>

#include "pipeline/frame/matte.h"
#include "pipeline/matte/picture.h"

namespace rinkaku::matte {

struct RefinementOptions {
  /// How far a border may move, as a part of the picture's height.
  double reach = 0.011;
  /// What counts as a border of the plate: the standard deviation of a colour component, of 255.
  double edge = 5;
  /// How much of the last matte is kept where the plate stays as it was, 0 to 1.
  double steady = 0.7;
};

/// Moves a matte's borders to the plate's own, and keeps them steady where nothing moves.
///
/// The guided filter of He, Sun and Tang, "Guided image filtering", 2013, with the colour as its guide (equations 16 to
/// 19), its coefficients found on a coarser grid ("Fast guided filter", 2015). Before it, where the plate's brightness
/// is that of the frame before, the matte is mixed with the last one; where anything moves it is not, so that it
/// doesn't lag. Only what lies within the reach of a soft pixel is touched.
class Refinement {
 public:
  explicit Refinement(const RefinementOptions& options = {}) : options_(options) {}

  /// Changes matte.alpha and matte.rect; its own colours must be found afterwards. Frames come in their order. About
  /// 3 ns a pixel of the picture and 20 ns a pixel of the matte's rectangle.
  void refine(const Picture& picture, Matte& matte);

 private:
  void shrink(const Picture& picture, const Matte& matte);
  void steady(const cv::Rect& part);
  void solve(const cv::Rect& part, const cv::Size& box);
  void apply(const Picture& picture, const cv::Rect& part, Matte& matte) const;

  RefinementOptions options_;
  cv::Mat luma_, cb_, cr_, alpha_;  // CV_32F on the grid, all of the picture
  cv::Mat last_luma_, last_alpha_;  // likewise, of the last frame
  cv::Rect last_part_;              // where they are of any use
  cv::Mat small_, moved_;           // scratch
  cv::Mat firsts_, seconds_, thirds_, last_product_, coefficients_;
  cv::Mat least_, most_;  // of the matte, within reach
};

}  // namespace rinkaku::matte
