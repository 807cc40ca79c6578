#include "pipeline/matte/known_background.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace rinkaku::matte {
namespace {

cv::Rect as_rect(const PixelRect& r) { return {r.x_px, r.y_px, r.width_px, r.height_px}; }

void read_ycc(const Picture& picture, const PixelRect& rect, cv::Mat& out) {
  out.create(rect.height_px, rect.width_px, CV_32FC3);
  for (int y = 0; y < rect.height_px; ++y) {
    auto* row = out.ptr<cv::Vec3f>(y);
    for (int x = 0; x < rect.width_px; ++x) row[x] = picture.ycc(rect.x_px + x, rect.y_px + y);
  }
}

std::uint8_t level(float value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0f, 255.0f) + 0.5f); }

}  // namespace

void KnownBackground::solve(const Picture& picture, const cv::Mat& rough, const cv::Mat& behind, const Options& options,
                            Matte& matte) {
  const PixelRect& rect = matte.rect;
  if (rect.empty()) return;
  const cv::Mat mask = rough(as_rect(rect));
  read_ycc(picture, rect, seen_);
  const int side = 2 * options.band_px + 1;
  const cv::Mat disk = cv::getStructuringElement(cv::MORPH_ELLIPSE, {side, side});
  cv::threshold(mask, reached_, 127, 255, cv::THRESH_BINARY);
  cv::erode(reached_, core_, disk);
  cv::dilate(reached_, reached_, disk);

  // The thing's colour near each pixel: a mean over the core around, weighted by nearness.
  core_.convertTo(weight_, CV_32F, 1.0 / 255, 1e-5);
  cv::Mat weights[] = {weight_, weight_, weight_}, weight3;
  cv::merge(weights, 3, weight3);
  cv::multiply(seen_, weight3, own_);
  const cv::Size reach(4 * options.band_px + 1, 4 * options.band_px + 1);
  for (int pass = 0; pass < 2; ++pass) {
    cv::boxFilter(pass == 0 ? own_ : own_, own_, -1, reach, {-1, -1}, true, cv::BORDER_REPLICATE);
    cv::boxFilter(pass == 0 ? weight_ : weight_blurred_, weight_blurred_, -1, reach, {-1, -1}, true,
                  cv::BORDER_REPLICATE);
  }

  difference_.create(mask.size(), CV_32F);
  const float chroma2 = options.chroma * options.chroma;
  for (int y = 0; y < mask.rows; ++y) {
    const auto *p = seen_.ptr<cv::Vec3f>(y), *b = behind.ptr<cv::Vec3f>(y);
    float* d = difference_.ptr<float>(y);
    for (int x = 0; x < mask.cols; ++x) {
      const cv::Vec3f v = p[x] - b[x];
      d[x] = std::sqrt(v[0] * v[0] + chroma2 * (v[1] * v[1] + v[2] * v[2]));
    }
  }
  cv::blur(difference_, difference_, {3, 3});
  cv::dilate(difference_, strongest_, cv::getStructuringElement(cv::MORPH_RECT, {5, 5}));
  cv::GaussianBlur(mask, soft_, {}, 3);

  cv::Mat alpha(matte.height_px, matte.width_px, CV_8U, matte.alpha.data());
  alpha = alpha(as_rect(rect));
  for (int y = 0; y < mask.rows; ++y) {
    const auto *p = seen_.ptr<cv::Vec3f>(y), *b = behind.ptr<cv::Vec3f>(y), *f = own_.ptr<cv::Vec3f>(y);
    const float *w = weight_blurred_.ptr<float>(y), *d = difference_.ptr<float>(y), *m = strongest_.ptr<float>(y);
    const auto *core = core_.ptr<std::uint8_t>(y), *reached = reached_.ptr<std::uint8_t>(y);
    const std::uint8_t* soft = soft_.ptr<std::uint8_t>(y);
    auto* out = alpha.ptr<std::uint8_t>(y);
    for (int x = 0; x < mask.cols; ++x) {
      if (core[x] != 0 || reached[x] == 0) {
        out[x] = core[x];
        continue;
      }
      const cv::Vec3f way = f[x] / w[x] - b[x], gone = p[x] - b[x];
      const float length2 = way[0] * way[0] + chroma2 * (way[1] * way[1] + way[2] * way[2]);
      const float along = (way[0] * gone[0] + chroma2 * (way[1] * gone[1] + way[2] * gone[2])) / std::max(length2, 1.f);
      const float beside = (d[x] - options.noise) /
                           std::max({0.86f * m[x] - options.noise, 0.5f * std::sqrt(length2), 2 * options.noise});
      // Each errs towards too little: by colour where the thing is of several colours, by strength where it is faint.
      const auto [less, more] = std::minmax({std::clamp(along, 0.f, 1.f), std::clamp(beside, 0.f, 1.f)});
      const float by_colour = 0.27f * less + 0.73f * more;
      const float contrast = std::max(m[x], std::sqrt(length2));
      const float trust = std::clamp((contrast - 2 * options.noise) / (5 * options.noise), 0.f, 1.f);
      out[x] = level(255 * trust * by_colour + (1 - trust) * soft[x]);
    }
  }
  cv::medianBlur(alpha.clone(), alpha, 5);
  for (int y = 0; y < mask.rows; ++y) {
    const auto *p = seen_.ptr<cv::Vec3f>(y), *b = behind.ptr<cv::Vec3f>(y);
    const auto* a = alpha.ptr<std::uint8_t>(y);
    std::uint8_t* own =
        matte.own_rgb.data() + (static_cast<std::size_t>(rect.y_px + y) * matte.width_px + rect.x_px) * 3;
    for (int x = 0; x < mask.cols; ++x) {
      if (a[x] == 0 || a[x] == 255) continue;
      const float share = static_cast<float>(a[x]) / 255;
      const cv::Vec3f rgb = to_rgb(picture.rgb_from_ycc, (p[x] - (1 - share) * b[x]) / share);
      for (int c = 0; c < 3; ++c) own[3 * x + c] = level(rgb[c]);
    }
  }
}

}  // namespace rinkaku::matte
