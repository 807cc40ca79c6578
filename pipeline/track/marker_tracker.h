#pragma once

#include <memory>

#include "pipeline/frame/camera_model.h"
#include "pipeline/track/board.h"
#include "pipeline/track/tracker.h"

namespace rinkaku::track {

/// Tracks the camera by a board's markers (one or several), frame by frame, on the frame's own brightness plane.
///
/// The world is the board's frame (see Board). All markers seen are solved jointly, lens distortion included; some are
/// enough, and those that contradict the others are left out. Of a plane's two poses the one is given that fits better
/// over time. Measured poses only: a frame without a marker gives none (see steady.h for holding, fading and
/// smoothing). Throws Error (Input) if the board is a chessboard or has no markers. Frames must have the camera's
/// resolution (see check_resolution); others give no pose. Costs about 4 ms at 640x480 and 9 ms at 1920x1080, more on
/// frames where a marker just seen is missed.
std::unique_ptr<Tracker> make_marker_tracker(const Board& board, const CameraModel& camera);

}  // namespace rinkaku::track
