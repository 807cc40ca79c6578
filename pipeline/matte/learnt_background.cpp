#include "pipeline/matte/learnt_background.h"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace rinkaku::matte {

LearntBackground::LearntBackground(int memory_frames)
    : model_(cv::createBackgroundSubtractorMOG2(memory_frames, 16, false)), memory_frames_(memory_frames) {}

void LearntBackground::learn(const Picture& picture, const cv::Mat& small) {
  const cv::Scalar middle(picture.black, 128, 128);
  cv::Mat(small + middle).convertTo(bytes_, CV_8UC3);
  // Fast at first, so that few frames suffice.
  const double rate = 1.0 / std::min(memory_frames_, std::max(2, frames_ + 1));
  model_->apply(bytes_, foreground_, rate);
  model_->getBackgroundImage(learnt_);
  learnt_.convertTo(small_background_, CV_32F);
  small_background_ -= middle;

  const int width = picture.width_px(), height = picture.height_px();
  const int factor_x = width / small.cols, factor_y = height / small.rows;
  if (background_.empty()) {
    background_.create(height, width, CV_32FC3);
    for (int y = 0; y < height; ++y) {
      auto* out = background_.ptr<cv::Vec3f>(y);
      for (int x = 0; x < width; ++x) out[x] = picture.ycc(x, y);
    }
  }
  ++frames_;
  // Where the frame is the model's background now, its detail is taken over; where the model has changed its mind for
  // good, the old detail goes.
  constexpr float agrees = 8, share = 0.2f;
  for (int y = 0; y < height; ++y) {
    const int small_y = std::min(y / factor_y, small.rows - 1);
    const auto *now = small.ptr<cv::Vec3f>(small_y), *model = small_background_.ptr<cv::Vec3f>(small_y);
    auto* out = background_.ptr<cv::Vec3f>(y);
    for (int small_x = 0; small_x < small.cols; ++small_x) {
      const cv::Vec3f apart = now[small_x] - model[small_x];
      if (std::abs(apart[0]) + std::abs(apart[1]) + std::abs(apart[2]) > agrees) continue;
      const int end = small_x + 1 == small.cols ? width : (small_x + 1) * factor_x;
      for (int x = small_x * factor_x; x < end; ++x) out[x] += share * (picture.ycc(x, y) - out[x]);
    }
  }
}

}  // namespace rinkaku::matte
