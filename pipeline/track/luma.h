#pragma once

#include <opencv2/core.hpp>

#include "pipeline/frame/frame.h"

namespace rinkaku::track {

/// The brightness of a frame as an 8-bit picture for detectors.
///
/// An 8-bit Y (or grey) plane whose samples lie side by side is not copied: the result points into the frame and lives
/// as long as it. Everything else (deeper samples, packed layouts, RGB) is written to `scratch`, which the result then
/// shares. Levels are as stored; limited range is not stretched. RGB is weighted 0.299, 0.587, 0.114.
/// Costs nothing, or one pass over the picture.
cv::Mat luma(const Frame& frame, cv::Mat& scratch);

}  // namespace rinkaku::track
