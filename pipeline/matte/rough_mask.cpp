#include "pipeline/matte/rough_mask.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace rinkaku::matte {
namespace {

// What noise, compression and rounding do to a smoothed difference of an ordinary camera's pictures, in 8-bit levels.
constexpr float luma_noise = 6, shaded_chroma_noise = 3, texture_noise = 5;
constexpr float most_light = 1.35f;
// Of the threshold: what is enough beside the thing, and what a hole may have on average.
constexpr float weak_part = 0.65f, hole_part = 0.35f;
// What is faint: so many times what the background itself differs by there, but at least this part of the threshold.
constexpr float times_background = 6, faint_part = 0.22f;

}  // namespace

// Light is measured where the colour, freed from brightness, is the background's.
void RoughMask::follow_light(const cv::Mat& picture, const cv::Mat& background, LightField& light) {
  luma_.create(picture.size(), CV_32F);
  background_luma_.create(picture.size(), CV_32F);
  usable_.create(picture.size(), CV_32F);
  const bool known = !light.gain().empty();
  for (int y = 0; y < picture.rows; ++y) {
    const auto *p = picture.ptr<cv::Vec3f>(y), *b = background.ptr<cv::Vec3f>(y);
    const float* gain = known ? light.gain().ptr<float>(y) : nullptr;
    const std::uint8_t* inside = mask_.empty() ? nullptr : mask_.ptr<std::uint8_t>(y);
    float *luma = luma_.ptr<float>(y), *then = background_luma_.ptr<float>(y), *use = usable_.ptr<float>(y);
    for (int x = 0; x < picture.cols; ++x) {
      luma[x] = p[x][0];
      then[x] = b[x][0];
      const float ratio = p[x][0] / std::max(b[x][0], 8.f);
      const float cb = p[x][1] - ratio * b[x][1], cr = p[x][2] - ratio * b[x][2];
      const float change = gain == nullptr ? 1 : ratio / gain[x];
      const bool good = cb * cb + cr * cr < 25 && change > 0.7f && change < 1.43f && ratio > 0.3f && ratio < 3 &&
                        (inside == nullptr || inside[x] == 0);
      use[x] = good ? 1.f : 0.f;
    }
  }
  light.follow(luma_, background_luma_, usable_);
}

// The distance of each pixel from the background, in units of noise.
void RoughMask::measure(const cv::Mat& picture, const cv::Mat& background, const LightField& light,
                        const Options& options) {
  const cv::Size size = picture.size();
  // What the background's brightness should be, and how much of it there is around each pixel: shadows.
  cv::multiply(background_luma_, light.gain(), expected_);
  cv::boxFilter(luma_, light_now_, CV_32F, {3, 3});
  cv::boxFilter(expected_, light_then_, CV_32F, {3, 3});
  residual_.create(size, CV_32FC3);
  texture_.create(size, CV_32F);
  shade_.create(size, CV_32F);
  for (int y = 0; y < size.height; ++y) {
    const auto *p = picture.ptr<cv::Vec3f>(y), *b = background.ptr<cv::Vec3f>(y);
    const float *now = light_now_.ptr<float>(y), *then = light_then_.ptr<float>(y), *e = expected_.ptr<float>(y);
    const float* gain = light.gain().ptr<float>(y);
    auto* r = residual_.ptr<cv::Vec3f>(y);
    float *t = texture_.ptr<float>(y), *shade = shade_.ptr<float>(y);
    for (int x = 0; x < size.width; ++x) {
      const float s = now[x] / std::max(then[x], 4.f);
      const float taken = std::clamp(s, options.deepest_shadow, most_light);
      shade[x] = taken * gain[x];
      r[x] = {p[x][0] - taken * e[x], p[x][1] - shade[x] * b[x][1], p[x][2] - shade[x] * b[x][2]};
      const float detail = p[x][0] - s * e[x];
      t[x] = detail * detail;
    }
  }
  cv::GaussianBlur(residual_, smooth_, {3, 3}, 0);
  cv::boxFilter(texture_, texture_, CV_32F, {3, 3});
  distance_.create(size, CV_32F);
  constexpr float luma2 = 1 / (luma_noise * luma_noise), texture2 = 1 / (texture_noise * texture_noise);
  for (int y = 0; y < size.height; ++y) {
    const auto* r = smooth_.ptr<cv::Vec3f>(y);
    const float *t = texture_.ptr<float>(y), *shade = shade_.ptr<float>(y), *gain = light.gain().ptr<float>(y);
    const float* e = expected_.ptr<float>(y);
    float* d = distance_.ptr<float>(y);
    for (int x = 0; x < size.width; ++x) {
      // Highlights are pale: shaded, they get their colour back.
      const float pale = shade[x] < gain[x] ? std::clamp((e[x] - 150) / 50, 0.f, 1.f) : 0;
      const float chroma = shaded_chroma_noise + 5 * pale;
      d[x] = std::sqrt(luma2 * r[x][0] * r[x][0] + 1 / (chroma * chroma) * (r[x][1] * r[x][1] + r[x][2] * r[x][2]) +
                       texture2 * t[x]);
    }
  }
}

// Parts of the thing that hardly differ from what is behind them: where the threshold is met by far, yet all around the
// background is met much better still. They lie against what is sure, and are thicker than the sure parts' soft
// borders, which differ as little.
void RoughMask::find_faint(const cv::Mat& sure, const Options& options) {
  const cv::Mat cross = cv::getStructuringElement(cv::MORPH_CROSS, {3, 3});
  const cv::Mat wide = cv::getStructuringElement(cv::MORPH_RECT, {13, 13});
  const cv::Size around(61, 61);
  cv::dilate(sure, faint_, wide);
  faint_.convertTo(weight_, CV_32F, -1.0 / 255, 1 + 1e-6);
  cv::multiply(distance_, weight_, weighted_);
  cv::boxFilter(weighted_, weighted_, CV_32F, around);
  cv::boxFilter(weight_, weight_, CV_32F, around);
  cv::divide(weighted_, weight_, weighted_, times_background);
  const cv::Mat enough = cv::max(weighted_, faint_part * options.threshold), differs = distance_ > enough;
  cv::dilate(sure, faint_, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}));
  faint_ = differs & ~faint_;
  cv::morphologyEx(faint_, faint_, cv::MORPH_OPEN, cross);
  cv::dilate(faint_, faint_, cv::getStructuringElement(cv::MORPH_RECT, {5, 5}));
  faint_ &= differs;
}

void RoughMask::clean_up(const Options& options) {
  cv::Mat above = distance_ > options.threshold;
  cv::morphologyEx(above, above, cv::MORPH_OPEN, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}));
  // Beside what is surely not background less is asked.
  cv::Mat near, weak = distance_ > weak_part * options.threshold;
  if (options.find_faint) {
    find_faint(above | weak, options);
    weak |= faint_;
  }
  cv::morphologyEx(weak, weak, cv::MORPH_OPEN, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}));
  cv::dilate(above, near, cv::getStructuringElement(cv::MORPH_ELLIPSE, {17, 17}));
  above |= weak & near;
  cv::morphologyEx(above, above, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_ELLIPSE, {3, 3}));
  const int pieces = cv::connectedComponentsWithStats(above, labels_, stats_, centres_);
  std::vector<std::uint8_t> keep(static_cast<std::size_t>(pieces), 0);
  for (int i = 1; i < pieces; ++i) {
    keep[static_cast<std::size_t>(i)] = stats_.at<int>(i, cv::CC_STAT_AREA) >= options.least_px ? 255 : 0;
  }
  mask_.create(above.size(), CV_8U);
  for (int y = 0; y < mask_.rows; ++y) {
    const int* label = labels_.ptr<int>(y);
    auto* out = mask_.ptr<std::uint8_t>(y);
    for (int x = 0; x < mask_.cols; ++x) out[x] = keep[static_cast<std::size_t>(label[x])];
  }
  // Holes that are small, or not quite the background, are where the thing looks like it by chance.
  const int holes = cv::connectedComponentsWithStats(~mask_, labels_, stats_, centres_, 4);
  std::vector<std::uint8_t> fill(static_cast<std::size_t>(holes), 0);
  std::vector<double> apart(fill.size(), 0);
  for (int y = 0; y < mask_.rows; ++y) {
    const int* label = labels_.ptr<int>(y);
    const float* d = distance_.ptr<float>(y);
    for (int x = 0; x < mask_.cols; ++x) apart[static_cast<std::size_t>(label[x])] += d[x];
  }
  for (int i = 1; i < holes; ++i) {
    const int area = stats_.at<int>(i, cv::CC_STAT_AREA);
    const bool background = apart[static_cast<std::size_t>(i)] < hole_part * options.threshold * area;
    fill[static_cast<std::size_t>(i)] = area < options.least_px / 8 || !background ? 255 : 0;
  }
  for (int y = 0; y < mask_.rows; ++y) {
    const int* label = labels_.ptr<int>(y);
    auto* out = mask_.ptr<std::uint8_t>(y);
    for (int x = 0; x < mask_.cols; ++x) out[x] |= fill[static_cast<std::size_t>(label[x])];
  }
}

// Inside the mask and near it, where the thing itself disturbs it, the light is that around.
void RoughMask::fill_shade() {
  cv::Mat near;
  cv::dilate(mask_, near, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}));
  near.convertTo(weight_, CV_32F, -1.0 / 255, 1 + 1e-4);
  cv::multiply(shade_, weight_, weighted_);
  cv::boxFilter(weighted_, weighted_, CV_32F, {21, 21});
  cv::boxFilter(weight_, weight_, CV_32F, {21, 21});
  cv::divide(weighted_, weight_, weighted_);
  weighted_.copyTo(shade_, near);
}

void RoughMask::find(const cv::Mat& picture, const cv::Mat& background, LightField& light, const Options& options) {
  follow_light(picture, background, light);
  measure(picture, background, light, options);
  clean_up(options);
  fill_shade();
}

}  // namespace rinkaku::matte
