#pragma once

#include <opencv2/core.hpp>
#include <opencv2/video/background_segm.hpp>

#include "pipeline/matte/picture.h"

namespace rinkaku::matte {

/// The empty scene, learnt from frames that things pass through.
///
/// A mixture of Gaussians for each pixel of the small picture (OpenCV's MOG2) says what is background; where the frame
/// agrees, the background's picture in full size moves towards it.
class LearntBackground {
 public:
  /// What has been seen in most of so many frames is background.
  explicit LearntBackground(int memory_frames);

  /// `small`: CV_32FC3, luma above black, Cb and Cr from their middle.
  void learn(const Picture& picture, const cv::Mat& small);

  bool ready() const { return frames_ >= 2; }
  const cv::Mat& background() const { return background_; }              ///< CV_32FC3, Y Cb Cr, full size
  const cv::Mat& small_background() const { return small_background_; }  ///< as learn()'s

 private:
  cv::Ptr<cv::BackgroundSubtractorMOG2> model_;
  int memory_frames_;
  int frames_ = 0;
  cv::Mat background_, small_background_;
  cv::Mat bytes_, foreground_, learnt_;
};

}  // namespace rinkaku::matte
