#include "pipeline/matte/refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "pipeline/matte/estimator.h"

namespace rinkaku::matte {
namespace {

constexpr int grid_rows = 180;  // about
constexpr float moving = 2;     // mean difference of brightness that is no noise any more, of 255

int step_of(int height_px) {
  return std::max(1, static_cast<int>(std::lround(height_px / static_cast<double>(grid_rows))));
}

// A plane on the grid, as floats.
void onto_grid(const cv::Mat& plane, const cv::Size& grid, cv::Mat& scratch, cv::Mat& out) {
  cv::resize(plane, scratch, grid, 0, 0, cv::INTER_AREA);
  scratch.convertTo(out, CV_32F);
}

using Coefficients = cv::Vec4f;  // of Y, Cb, Cr, and the rest

}  // namespace

void Refinement::shrink(const Picture& picture, const Matte& matte) {
  const int step = step_of(picture.height_px());
  const cv::Size grid((picture.width_px() + step - 1) / step, (picture.height_px() + step - 1) / step);
  onto_grid(picture.luma, grid, small_, luma_);
  onto_grid(picture.cb, grid, small_, cb_);
  onto_grid(picture.cr, grid, small_, cr_);
  const cv::Mat alpha(matte.height_px, matte.width_px, CV_8U, const_cast<std::uint8_t*>(matte.alpha.data()));
  onto_grid(alpha, grid, small_, alpha_);
}

// Where the plate stays as it was, the matte nearly does.
void Refinement::steady(const cv::Rect& part) {
  const cv::Rect known = part & last_part_;
  if (last_alpha_.size() == alpha_.size() && !known.empty()) {
    cv::absdiff(luma_(known), last_luma_(known), moved_);
    cv::boxFilter(moved_, moved_, -1, {5, 5});
    const float keep = static_cast<float>(options_.steady);
    for (int y = 0; y < known.height; ++y) {
      const float *moved = moved_.ptr<float>(y), *last = last_alpha_.ptr<float>(known.y + y) + known.x;
      float* now = alpha_.ptr<float>(known.y + y) + known.x;
      for (int x = 0; x < known.width; ++x) {
        const float m = moved[x] / moving;
        if (m < 2) now[x] += keep * std::exp(-m * m) * (last[x] - now[x]);
      }
    }
  }
  alpha_.copyTo(last_alpha_);
  luma_.copyTo(last_luma_);
  last_part_ = part;
}

// The linear functions of colour that give the matte, each the mean over the boxes that hold a point of the grid.
void Refinement::solve(const cv::Rect& part, const cv::Size& box) {
  firsts_.create(part.size(), CV_32FC4);
  seconds_.create(part.size(), CV_32FC4);
  thirds_.create(part.size(), CV_32FC4);
  last_product_.create(part.size(), CV_32F);
  for (int row = 0; row < part.height; ++row) {
    const float *y = luma_.ptr<float>(part.y + row) + part.x, *b = cb_.ptr<float>(part.y + row) + part.x;
    const float *r = cr_.ptr<float>(part.y + row) + part.x, *a = alpha_.ptr<float>(part.y + row) + part.x;
    auto *first = firsts_.ptr<cv::Vec4f>(row), *second = seconds_.ptr<cv::Vec4f>(row);
    auto* third = thirds_.ptr<cv::Vec4f>(row);
    float* last = last_product_.ptr<float>(row);
    for (int x = 0; x < part.width; ++x) {
      first[x] = {y[x], b[x], r[x], a[x]};
      second[x] = {y[x] * y[x], y[x] * b[x], y[x] * r[x], b[x] * b[x]};
      third[x] = {b[x] * r[x], r[x] * r[x], y[x] * a[x], b[x] * a[x]};
      last[x] = r[x] * a[x];
    }
  }
  for (cv::Mat* mat : {&firsts_, &seconds_, &thirds_, &last_product_}) {
    cv::boxFilter(*mat, *mat, -1, box, {-1, -1}, true, cv::BORDER_REFLECT);
  }
  coefficients_.create(part.size(), CV_32FC4);
  const float even = static_cast<float>(options_.edge * options_.edge);
  for (int row = 0; row < part.height; ++row) {
    const auto *first = firsts_.ptr<cv::Vec4f>(row), *second = seconds_.ptr<cv::Vec4f>(row);
    const auto* third = thirds_.ptr<cv::Vec4f>(row);
    const float* last = last_product_.ptr<float>(row);
    auto* out = coefficients_.ptr<Coefficients>(row);
    for (int x = 0; x < part.width; ++x) {
      const float y = first[x][0], b = first[x][1], r = first[x][2], a = first[x][3];
      const float yy = second[x][0] - y * y + even, yb = second[x][1] - y * b, yr = second[x][2] - y * r;
      const float bb = second[x][3] - b * b + even, br = third[x][0] - b * r, rr = third[x][1] - r * r + even;
      const cv::Vec3f with(third[x][2] - y * a, third[x][3] - b * a, last[x] - r * a);
      // The inverse of a symmetric matrix, by its cofactors; `even` keeps its determinant from vanishing.
      const float c00 = bb * rr - br * br, c01 = yr * br - yb * rr, c02 = yb * br - yr * bb;
      const float c11 = yy * rr - yr * yr, c12 = yb * yr - yy * br, c22 = yy * bb - yb * yb;
      const float scale = 1 / (yy * c00 + yb * c01 + yr * c02);
      const float of_y = scale * (c00 * with[0] + c01 * with[1] + c02 * with[2]);
      const float of_b = scale * (c01 * with[0] + c11 * with[1] + c12 * with[2]);
      const float of_r = scale * (c02 * with[0] + c12 * with[1] + c22 * with[2]);
      out[x] = {of_y, of_b, of_r, a - of_y * y - of_b * b - of_r * r};
    }
  }
  cv::boxFilter(coefficients_, coefficients_, -1, box, {-1, -1}, true, cv::BORDER_REFLECT);
}

void Refinement::apply(const Picture& picture, const cv::Rect& part, Matte& matte) const {
  constexpr float gain = 1.35f;  // the filter leaves a trace of each side on the other
  const float across = static_cast<float>(alpha_.cols) / static_cast<float>(matte.width_px);
  const float down = static_cast<float>(alpha_.rows) / static_cast<float>(matte.height_px);
  const int step = step_of(picture.height_px());
  const int left = part.x * step, right = std::min(matte.width_px, (part.x + part.width) * step);
  const int bottom = std::min(matte.height_px, (part.y + part.height) * step);
  for (int y = part.y * step; y < bottom; ++y) {
    const float at_y = std::clamp((static_cast<float>(y) + 0.5f) * down - 0.5f - static_cast<float>(part.y), 0.0f,
                                  static_cast<float>(part.height - 1));
    const int row = std::min(static_cast<int>(at_y), std::max(part.height - 2, 0));
    const float below = at_y - static_cast<float>(row);
    const auto* upper = coefficients_.ptr<Coefficients>(row);
    const auto* lower = coefficients_.ptr<Coefficients>(std::min(row + 1, part.height - 1));
    const int nearest = std::min(static_cast<int>(at_y + 0.5f), part.height - 1);
    const float *least = least_.ptr<float>(nearest), *most = most_.ptr<float>(nearest);
    std::uint8_t* out = matte.alpha_row(y);
    for (int x = left; x < right; ++x) {
      const float at_x = std::clamp((static_cast<float>(x) + 0.5f) * across - 0.5f - static_cast<float>(part.x), 0.0f,
                                    static_cast<float>(part.width - 1));
      const int near_x = std::min(static_cast<int>(at_x + 0.5f), part.width - 1);
      if (most[near_x] < 1 || least[near_x] > 254) {
        out[x] = most[near_x] < 1 ? 0 : 255;
        continue;
      }
      const int column = static_cast<int>(at_x), next = std::min(column + 1, part.width - 1);
      const float beside = at_x - static_cast<float>(column);
      const Coefficients above_here = upper[column] + beside * (upper[next] - upper[column]);
      const Coefficients below_here = lower[column] + beside * (lower[next] - lower[column]);
      const Coefficients c = above_here + below * (below_here - above_here);
      const cv::Vec3f ycc = picture.ycc(x, y);
      const float alpha = c[0] * ycc[0] + c[1] * ycc[1] + c[2] * ycc[2] + c[3];
      out[x] = static_cast<std::uint8_t>(std::clamp((alpha - 127.5f) * gain + 128, 0.0f, 255.0f));
    }
  }
}

void Refinement::refine(const Picture& picture, Matte& matte) {
  shrink(picture, matte);
  const int step = step_of(matte.height_px);
  const int reach = std::max(1, static_cast<int>(std::lround(options_.reach * matte.height_px / step)));
  const int around = 2 * reach + 1;  // boxes over boxes
  const PixelRect& rect = matte.rect;
  const cv::Rect whole({}, alpha_.size());
  cv::Rect part = cv::Rect(cv::Point(rect.x_px / step - around, rect.y_px / step - around),
                           cv::Point(rect.right_px() / step + 1 + around, rect.bottom_px() / step + 1 + around)) &
                  whole;
  if (rect.empty()) part = {};
  steady(part);
  if (part.empty()) return;
  const cv::Size box(2 * reach + 1, 2 * reach + 1);
  const cv::Mat near = cv::getStructuringElement(cv::MORPH_RECT, box);
  cv::erode(alpha_(part), least_, near);
  cv::dilate(alpha_(part), most_, near);
  solve(part, box);
  apply(picture, part, matte);
  find_rect(matte);
}

}  // namespace rinkaku::matte
