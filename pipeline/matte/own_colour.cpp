#include "pipeline/matte/own_colour.h"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace rinkaku::matte {
namespace {

constexpr int step = 2;                // pixels to one of the means' grid
constexpr int reach = 9, around = 16;  // of a box, twice; in the grid, and in pixels

std::uint8_t level(float value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0f, 255.0f) + 0.5f); }

void blur(cv::Mat& mat) {
  for (int pass = 0; pass < 2; ++pass) cv::boxFilter(mat, mat, -1, {reach, reach});
}

}  // namespace

void OwnColours::find(const Picture& picture, Matte& matte) {
  if (matte.rect.empty()) return;
  const PixelRect rect = intersection({matte.rect.x_px - around, matte.rect.y_px - around,
                                       matte.rect.width_px + 2 * around, matte.rect.height_px + 2 * around},
                                      {0, 0, matte.width_px, matte.height_px});
  const int columns = (rect.width_px + step - 1) / step, rows = (rect.height_px + step - 1) / step;
  own_.create(rows, columns, CV_32FC3);
  behind_.create(rows, columns, CV_32FC3);
  own_weight_.create(rows, columns, CV_32F);
  behind_weight_.create(rows, columns, CV_32F);
  for (int y = 0; y < rows; ++y) {
    const int picture_y = rect.y_px + y * step;
    const std::uint8_t* alpha = matte.alpha_row(picture_y);
    auto *own = own_.ptr<cv::Vec3f>(y), *behind = behind_.ptr<cv::Vec3f>(y);
    float *own_weight = own_weight_.ptr<float>(y), *behind_weight = behind_weight_.ptr<float>(y);
    for (int x = 0; x < columns; ++x) {
      const int picture_x = rect.x_px + x * step;
      const float a = static_cast<float>(alpha[picture_x]) / 255, rest = 1 - a;
      const cv::Vec3f seen = picture.ycc(picture_x, picture_y);
      // The more decided a pixel, the more it says; a trace of each keeps the weights from vanishing.
      own_weight[x] = a * a * a * a + 1e-4f;
      behind_weight[x] = rest * rest * rest * rest + 1e-4f;
      own[x] = own_weight[x] * seen;
      behind[x] = behind_weight[x] * seen;
    }
  }
  for (cv::Mat* mat : {&own_, &behind_, &own_weight_, &behind_weight_}) blur(*mat);
  for (int y = matte.rect.y_px; y < matte.rect.bottom_px(); ++y) {
    const std::uint8_t* alpha = matte.alpha_row(y);
    std::uint8_t* out = matte.own_rgb.data() + static_cast<std::size_t>(y) * matte.width_px * 3;
    const int row = (y - rect.y_px) / step;
    for (int x = matte.rect.x_px; x < matte.rect.right_px(); ++x) {
      if (alpha[x] == 0 || alpha[x] == 255) continue;
      const int column = (x - rect.x_px) / step;
      const float a = static_cast<float>(alpha[x]) / 255;
      const cv::Vec3f own = own_.at<cv::Vec3f>(row, column) / own_weight_.at<float>(row, column);
      const cv::Vec3f behind = behind_.at<cv::Vec3f>(row, column) / behind_weight_.at<float>(row, column);
      const cv::Vec3f missing = picture.ycc(x, y) - a * own - (1 - a) * behind;
      const cv::Vec3f rgb = to_rgb(picture.rgb_from_ycc, own + a * missing);
      for (int c = 0; c < 3; ++c) out[3 * x + c] = level(rgb[c]);
    }
  }
}

}  // namespace rinkaku::matte
