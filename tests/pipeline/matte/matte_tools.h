#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "pipeline/frame/matte.h"
#include "pipeline/matte/boundary_score.h"
#include "pipeline/matte/file_matte.h"
#include "tests/pipeline/source/media_tools.h"
#include "tests/support/test_data.h"

namespace rinkaku::test {

inline const std::string tripod = RINKAKU_SOURCE_DIR "/recordings/tripod/";

/// The mattes of a file, frame by frame.
inline std::unique_ptr<matte::FileMatte> file_matte(const std::string& file) {
  std::shared_ptr<source::Source> source = source::open(file);
  return std::make_unique<matte::FileMatte>(file, [source] { return source->next(); });
}

inline cv::Mat alpha_of(const Matte& matte) {
  return {matte.height_px, matte.width_px, CV_8U, const_cast<std::uint8_t*>(matte.alpha.data())};
}

/// How found mattes agree with true ones, over several frames.
class Agreement {
 public:
  void add(const Matte& found, const Matte& truth) {
    const cv::Mat a = alpha_of(found) > 127, b = alpha_of(truth) > 127;
    both_ += cv::countNonZero(a & b);
    either_ += cv::countNonZero(a | b);
    boundary_sum_ += matte::boundary_f(a, b, 3);
    ++frames_;
  }
  double iou() const { return either_ > 0 ? both_ / either_ : 1; }
  double boundary_f3() const { return boundary_sum_ / frames_; }

 private:
  double both_ = 0, either_ = 0, boundary_sum_ = 0;
  int frames_ = 0;
};

/// A 4:2:0 frame of one colour.
inline Frame plain_frame(int width, int height, int y, int cb, int cr, std::int64_t number = 0) {
  FramePool pool;
  Frame frame = pool.allocate(picture("yuv420p", width, height, {1, 1, 1, ColourTags::Range::Limited, 1}));
  frame.number = frame.pts = number;
  const int values[] = {y, cb, cr};
  for (std::size_t p = 0; p < 3; ++p) {
    for (int row = 0; row < frame.planes[p].rows; ++row) {
      std::fill_n(frame.planes[p].data + row * frame.planes[p].stride_bytes, frame.planes[p].row_bytes,
                  static_cast<std::uint8_t>(values[p]));
    }
  }
  return frame;
}

}  // namespace rinkaku::test
