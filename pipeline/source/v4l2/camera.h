#pragma once

#include <memory>
#include <string>
#include <vector>

#include "pipeline/source/source.h"
#include "pipeline/source/v4l2/controls.h"
#include "pipeline/source/v4l2/modes.h"

namespace rinkaku::source::v4l2 {

struct CameraOptions {
  std::string device{};                 ///< "/dev/video0", or the camera's name as `rinkaku devices` prints it
  ModeWish wish{};                      ///< what is left open is chosen well, see best_choice()
  std::vector<ControlWish> controls{};  ///< set before the first picture, and again when the camera comes back
};

/// Opens a camera by Video4Linux (memory-mapped streaming) and waits for its first picture.
///
/// Frames are writable copies with planes of their own: packed and interleaved formats are put in order, sample for
/// sample, MJPEG is decoded. Their times are the driver's, in microseconds since the first frame. The first next()
/// begins: what came before it is old. next() waits as long as it takes: a camera that is unplugged, broken or silent
/// is looked for by its identity, not by its number, and goes on when it is back, which health() tells meanwhile.
/// Descriptors and memory are given back each time. The description's notice says what was agreed. Throws Error (Input)
/// if there is no such camera, it has no readable format, or a control is wrong; Error (Runtime) if it is in use or
/// sends nothing for 5 s.
std::unique_ptr<Source> open_camera(const CameraOptions& options);

}  // namespace rinkaku::source::v4l2
