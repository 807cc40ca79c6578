#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/frame/camera_model.h"
#include "pipeline/frame/frame.h"
#include "pipeline/track/board.h"

namespace rinkaku::track {

struct CalibrateOptions {
  int most_views = 40;         ///< more cost time (its third power) and gain little
  double seconds_apart = 0.1;  ///< frames nearer to the last one looked at are passed over; 0 looks at all
};

/// A camera, and how far it can be trusted.
struct Calibration {
  CameraModel camera;
  double rms_px = 0;  ///< reprojection error over the views used
  int frames_looked_at = 0;
  int frames_with_board = 0;
  int views = 0;             ///< used in the end
  int views_rejected = 0;    ///< did not fit what the others say
  double coverage = 0;       ///< the part of the picture, 0 to 1, that the views' corners lie in (cells of a tenth)
  double most_tilt_deg = 0;  ///< of the board against the picture plane
  std::vector<std::string> warnings;  ///< in words, each with its remedy; empty if all is well
};

/// Finds a camera's intrinsics and lens distortion (k1, k2, p1, p2, and k3 where it earns its place) from pictures of a
/// board: a chessboard, a charuco board or a flat marker board.
///
/// `next` gives frames until it is empty. Of the frames that show the board, sharp ones are chosen that differ most in
/// the board's place, size and tilt; views that fit badly are left out. Throws Error (Input) naming the board if it is
/// not flat, frames differ in size, or fewer than 4 usable views are found; Error (Runtime) if no camera explains them.
/// Costs 10 to 100 ms a frame looked at and some seconds at the end. Any thread. Zhang, A Flexible New Technique for
/// Camera Calibration, 2000 (through OpenCV).
Calibration calibrate(const Board& board, const std::function<std::optional<Frame>()>& next,
                      const CalibrateOptions& options = {});

}  // namespace rinkaku::track
