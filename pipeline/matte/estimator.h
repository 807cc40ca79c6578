#pragma once

#include "pipeline/frame/frame.h"
#include "pipeline/frame/matte.h"

namespace rinkaku::matte {

/// One way to find out how much of each pixel a filmed thing covers.
///
/// Frames come in their order, one call each. Used from one thread at a time.
class MatteEstimator {
 public:
  virtual ~MatteEstimator() = default;

  virtual const char* name() const = 0;

  /// The frame's own matte: fills in everything but distance_m, and own_rgb only if it knows what lies behind the thing
  /// (knows_behind()). `matte`'s memory is reused. Throws Error (Runtime, Input) if the matte can't be had.
  virtual void estimate(const Frame& frame, Matte& matte) = 0;

  /// Whether estimate() fills in the thing's own colours.
  virtual bool knows_behind() const { return false; }
};

/// A matte of the frame's number and size that covers nothing, with memory for its alpha.
void begin_matte(const Frame& frame, Matte& matte);

/// Sets matte.rect to what its alpha covers. About 0.1 ns a pixel.
void find_rect(Matte& matte);

}  // namespace rinkaku::matte
