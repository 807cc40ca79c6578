#pragma once

#include <cstdint>
#include <vector>

namespace rinkaku::matte {

/// A matte as it is scored: 0 to 1, rows from the top without gaps, width_px * height_px values.
struct GreyMatte {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> alpha;
};

/// How far a matte is from the truth, over the whole picture.
struct Score {
  std::int64_t mismatch_px = 0;  ///< pixels whose values differ at all
  double iou = 1;                ///< of the pixels from 0.5 on: intersection over union; 1 if both have none
  double sad = 0;                ///< sum of |difference|
  double mse = 0;                ///< mean of difference squared
  double grad = 0;               ///< sum of (difference of the gradients' lengths) squared
  double conn = 0;               ///< sum of |difference of connectedness|
  double boundary_f1 = 1;        ///< F measure of the boundaries of the pixels from 0.5 on, matched within 1 pixel
  double boundary_f3 = 1;        ///< the same within 3 pixels
};

/// Scores a matte against the truth.
///
/// SAD, MSE, gradient and connectivity error are those of Rhemann et al., "A perceptually motivated online benchmark
/// for image matting", 2009: gradients by Gaussian derivatives of 1.4 pixels, of unit energy, cut where they fall below
/// 0.01, borders repeated; connectedness by thresholds of 0.1, 4-connected, theta = 0.15. Sums are plain (tables of
/// that benchmark show thousandths). The boundary measure is that of Perazzi et al., "A benchmark dataset and
/// evaluation methodology for video object segmentation", 2016, with the tolerance in pixels instead of a part of the
/// diagonal. Precondition: both have the same size, at least 1 x 1. Cost: about 0.2 microseconds a pixel.
Score score(const GreyMatte& matte, const GreyMatte& truth);

/// How unlike the truth a matte changes from one frame to the next: the root of the mean over the pixels of (change of
/// the matte - change of the truth) squared; 0 if it is always off by the same. This is dtSSD of Erofeev et al.,
/// "Perceptually motivated benchmark for video matting", 2015, by the pixel. Precondition: all four have one size.
double flicker(const GreyMatte& before, const GreyMatte& matte, const GreyMatte& truth_before, const GreyMatte& truth);

}  // namespace rinkaku::matte
