#pragma once

#include <opencv2/core.hpp>

#include "pipeline/frame/matte.h"
#include "pipeline/matte/picture.h"

namespace rinkaku::matte {

/// The exact alpha along the border of a thing before a known background.
///
/// In the band around the rough border alpha is how far the pixel's colour has gone from the background's (`behind`) to
/// the thing's, whose colour is taken from further inside, and how strong its difference is beside the strongest
/// nearby. Own colours follow from picture = alpha own + (1 - alpha) behind. Where the two colours hardly differ, the
/// rough border is taken, softened.
class KnownBackground {
 public:
  struct Options {
    int band_px = 4;   ///< to either side of the rough border
    float noise = 4;   ///< differences below this (8-bit levels) mean nothing
    float chroma = 2;  ///< the weight of chroma beside luma
  };

  /// `rough`: CV_8U, the whole picture, above 127 inside. `behind`: CV_32FC3, Y Cb Cr of the background of matte.rect.
  /// Sets alpha and own_rgb inside matte.rect. About 60 ns a pixel of the rectangle.
  void solve(const Picture& picture, const cv::Mat& rough, const cv::Mat& behind, const Options& options, Matte& matte);

  /// CV_8U, of the last rectangle: 0 where it is too far outside of the rough border to be looked at.
  const cv::Mat& reached() const { return reached_; }

 private:
  cv::Mat seen_, core_, reached_, weight_, own_, weight_blurred_, difference_, strongest_, soft_;
};

}  // namespace rinkaku::matte
