#pragma once

#include <opencv2/core.hpp>

#include "pipeline/frame/frame.h"

namespace rinkaku::matte {

/// A frame as matte estimators look at it: brightness of every pixel and chroma, 8 bits each.
///
/// Planes of an 8-bit planar Y'CbCr frame are not copied: they point into the frame and live as long as it. Deeper
/// samples are cut to 8 bits, packed layouts unpacked; RGB becomes full-range BT.601 without subsampling.
struct Picture {
  cv::Mat luma;  ///< CV_8U, the picture's size
  cv::Mat cb;    ///< CV_8U, on the chroma grid
  cv::Mat cr;
  int log2_chroma_width = 0;
  int log2_chroma_height = 0;
  cv::Matx34f rgb_from_ycc;  ///< takes (Y, Cb, Cr, 1) to R'G'B' in 0..255
  cv::Matx34f ycc_from_rgb;
  float black = 0;  ///< luma of black: 0, or 16 for limited range

  int width_px() const { return luma.cols; }
  int height_px() const { return luma.rows; }
  cv::Vec3f ycc(int x_px, int y_px) const {
    const int x = x_px >> log2_chroma_width, y = y_px >> log2_chroma_height;
    return {static_cast<float>(luma.at<std::uint8_t>(y_px, x_px)), static_cast<float>(cb.at<std::uint8_t>(y, x)),
            static_cast<float>(cr.at<std::uint8_t>(y, x))};
  }
};

/// The colour (Y, Cb, Cr) as R'G'B', not clipped.
inline cv::Vec3f to_rgb(const cv::Matx34f& rgb_from_ycc, const cv::Vec3f& ycc) {
  return rgb_from_ycc * cv::Vec4f(ycc[0], ycc[1], ycc[2], 1);
}

/// Makes Pictures of frames. Keeps scratch memory: one object a thread, and one Picture in use at a time.
class PictureReader {
 public:
  /// The result is valid until the next call, and while `frame` lives.
  const Picture& read(const Frame& frame);

 private:
  void read_ycc(const Frame& frame);
  void read_rgb(const Frame& frame);

  PictureFormat format_;  // that the matrices are for
  Picture picture_;
  cv::Mat planes_[3];
};

/// `from` in the colour coding of `to` (matrix and range), with full-size chroma: three planes Y, Cb, Cr of floats.
/// For pictures from elsewhere, such as clean plates. Some 20 ns a pixel.
cv::Mat recoded(const Picture& from, const cv::Matx34f& ycc_from_rgb);

}  // namespace rinkaku::matte
