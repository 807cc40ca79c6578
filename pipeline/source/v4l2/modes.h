#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "pipeline/frame/picture_format.h"
#include "pipeline/source/v4l2/device.h"
#include "pipeline/source/v4l2/pixel_layout.h"

namespace rinkaku::source::v4l2 {

/// One way in which a camera can send pictures.
struct Mode {
  FourCc format = 0;
  int width_px = 0;
  int height_px = 0;
  std::vector<Rational> rates;  ///< frames a second, the fastest first; empty if the camera doesn't tell
};

/// All modes a camera tells of, in its order. A camera that takes any size within limits is asked for the usual ones.
std::vector<Mode> modes_of(const Device& device);

/// What a user, a calibration or nobody asks of a camera.
struct ModeWish {
  FourCc format = 0;  ///< 0: any that is read
  int width_px = 0;   ///< 0: any
  int height_px = 0;
  Rational rate{0, 1};  ///< 0: any
};

/// A mode at one rate; 0/1 leaves the rate to the camera.
struct Choice {
  FourCc format = 0;
  int width_px = 0;
  int height_px = 0;
  Rational rate{0, 1};
};

/// The mode to ask for: what is wished, as far as the camera has it, else what is nearest in size, then in rate. Left
/// open, the size is the largest up to 1280x720, the rate the nearest to 30 a second, and of formats the one whose
/// samples cost least, so MJPEG only where that is larger or faster. Empty if no format of the camera's can be read or
/// the wished one isn't among them.
std::optional<Choice> best_choice(const std::vector<Mode>& modes, const ModeWish& wish);

}  // namespace rinkaku::source::v4l2
