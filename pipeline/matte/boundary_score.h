#pragma once

#include <opencv2/core/mat.hpp>

namespace rinkaku::matte {

/// The F measure of two binary pictures' boundaries (CV_8U, not 0 is inside), matched within `tolerance_px`.
///
/// A pixel is on the boundary if the one to the right, below, or below to the right is on the other side. Precision is
/// the part of `found`'s boundary near the true one, recall the part of the true one near `found`'s; 1 if neither has a
/// boundary, 0 if only one has.
double boundary_f(const cv::Mat& found, const cv::Mat& truth, int tolerance_px);

}  // namespace rinkaku::matte
