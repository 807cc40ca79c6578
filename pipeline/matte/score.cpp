#include "pipeline/matte/score.h"

#include <cmath>

#include <opencv2/imgproc.hpp>

#include "pipeline/matte/boundary_score.h"

namespace rinkaku::matte {
namespace {

cv::Mat as_mat(const GreyMatte& matte) {
  return cv::Mat(matte.height_px, matte.width_px, CV_32F, const_cast<float*>(matte.alpha.data()));
}

// The length of the gradient by Gaussian derivatives of unit energy.
cv::Mat gradient_length(const cv::Mat& alpha) {
  constexpr double sigma = 1.4, least = 1e-2;
  const double tau = std::sqrt(2 * M_PI);
  const int half = static_cast<int>(std::ceil(sigma * std::sqrt(-2 * std::log(tau * sigma * least))));
  cv::Mat smooth(2 * half + 1, 1, CV_64F), derivative(2 * half + 1, 1, CV_64F);
  for (int i = -half; i <= half; ++i) {
    const double g = std::exp(-i * i / (2 * sigma * sigma)) / (sigma * tau);
    smooth.at<double>(i + half) = g;
    derivative.at<double>(i + half) = -i * g / (sigma * sigma);
  }
  // The energy of a separable filter is the product of its factors' energies.
  smooth /= cv::norm(smooth);
  derivative /= cv::norm(derivative);
  cv::Mat along_x, along_y, length;
  cv::sepFilter2D(alpha, along_x, CV_64F, derivative, smooth, {-1, -1}, 0, cv::BORDER_REPLICATE);
  cv::sepFilter2D(alpha, along_y, CV_64F, smooth, derivative, {-1, -1}, 0, cv::BORDER_REPLICATE);
  cv::magnitude(along_x, along_y, length);
  return length;
}

// 255 in the largest 4-connected piece of `inside`, 0 elsewhere.
cv::Mat largest_piece(const cv::Mat& inside) {
  cv::Mat labels, stats, centres;
  const int count = cv::connectedComponentsWithStats(inside, labels, stats, centres, 4, CV_32S);
  int largest = -1, area = 0;
  for (int label = 1; label < count; ++label) {
    const int own = stats.at<int>(label, cv::CC_STAT_AREA);
    if (own > area) {
      area = own;
      largest = label;
    }
  }
  return labels == largest;
}

// Per pixel the largest threshold at which it still hangs together with the piece that both mattes share.
cv::Mat connected_up_to(const cv::Mat& alpha, const cv::Mat& truth) {
  constexpr int steps = 10;
  cv::Mat level(alpha.size(), CV_32F, cv::Scalar(1));
  cv::Mat decided = cv::Mat::zeros(alpha.size(), CV_8U);
  for (int step = 1; step <= steps; ++step) {
    const float threshold = static_cast<float>(step) / steps;
    const cv::Mat shared = largest_piece((alpha >= threshold) & (truth >= threshold));
    const cv::Mat left_out = ~shared & ~decided;
    level.setTo(static_cast<float>(step - 1) / steps, left_out);
    decided |= left_out;
  }
  return level;
}

double connectivity_error(const cv::Mat& alpha, const cv::Mat& truth) {
  constexpr float theta = 0.15f;
  const cv::Mat level = connected_up_to(alpha, truth);
  const auto connectedness = [&level](const cv::Mat& of) -> cv::Mat {
    cv::Mat apart = of - level;
    apart.setTo(0, apart < theta);
    return 1 - apart;
  };
  return cv::norm(connectedness(alpha), connectedness(truth), cv::NORM_L1);
}

}  // namespace

Score score(const GreyMatte& matte, const GreyMatte& truth) {
  const cv::Mat a = as_mat(matte), t = as_mat(truth);
  Score out;
  out.mismatch_px = cv::countNonZero(a != t);
  const cv::Mat inside = a >= 0.5, truly_inside = t >= 0.5;
  const int either = cv::countNonZero(inside | truly_inside);
  if (either > 0) out.iou = static_cast<double>(cv::countNonZero(inside & truly_inside)) / either;
  out.sad = cv::norm(a, t, cv::NORM_L1);
  out.mse = cv::norm(a, t, cv::NORM_L2SQR) / static_cast<double>(a.total());
  out.grad = cv::norm(gradient_length(a), gradient_length(t), cv::NORM_L2SQR);
  out.conn = connectivity_error(a, t);
  out.boundary_f1 = boundary_f(inside, truly_inside, 1);
  out.boundary_f3 = boundary_f(inside, truly_inside, 3);
  return out;
}

double flicker(const GreyMatte& before, const GreyMatte& matte, const GreyMatte& truth_before, const GreyMatte& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < matte.alpha.size(); ++i) {
    const double apart = (matte.alpha[i] - before.alpha[i]) - (truth.alpha[i] - truth_before.alpha[i]);
    sum += apart * apart;
  }
  return std::sqrt(sum / static_cast<double>(matte.alpha.size()));
}

}  // namespace rinkaku::matte
