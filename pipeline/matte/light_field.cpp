#include "pipeline/matte/light_field.h"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace rinkaku::matte {
namespace {

constexpr int cells_across = 32;
constexpr double smooth_cells = 1.2;
// Light that changes is followed within some ten frames.
constexpr float share_of_new = 0.3f;

}  // namespace

void LightField::follow(const cv::Mat& now, const cv::Mat& background, const cv::Mat& usable) {
  const int rows = std::max(1, cells_across * now.rows / now.cols);
  const cv::Size grid(std::min(cells_across, now.cols), std::min(rows, now.rows));
  // The ratio of sums weighs bright pixels more, whose ratio is less noisy.
  cv::multiply(now, usable, weighted_now_);
  cv::multiply(background, usable, weighted_background_);
  cv::resize(weighted_now_, now_cells_, grid, 0, 0, cv::INTER_AREA);
  cv::resize(weighted_background_, background_cells_, grid, 0, 0, cv::INTER_AREA);
  cv::GaussianBlur(now_cells_, now_cells_, {}, smooth_cells);
  cv::GaussianBlur(background_cells_, background_cells_, {}, smooth_cells);
  const bool first = cells_.empty();
  if (first) {
    cells_.create(grid, CV_32F);
    cells_.setTo(1);
  }
  for (int y = 0; y < grid.height; ++y) {
    const float *n = now_cells_.ptr<float>(y), *b = background_cells_.ptr<float>(y);
    float* cell = cells_.ptr<float>(y);
    for (int x = 0; x < grid.width; ++x) {
      // Where a thing covers nearly all around, the last value stays.
      constexpr float least = 2;
      if (b[x] < least) continue;
      const float found = std::clamp(n[x] / b[x], 0.3f, 3.0f);
      cell[x] = first ? found : cell[x] + share_of_new * (found - cell[x]);
    }
  }
  cv::resize(cells_, gain_, now.size(), 0, 0, cv::INTER_LINEAR);
}

}  // namespace rinkaku::matte
