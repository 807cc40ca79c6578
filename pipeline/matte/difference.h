#pragma once

#include <memory>
#include <optional>

#include "pipeline/matte/estimator.h"

namespace rinkaku::matte {

struct DifferenceOptions {
  /// How far a pixel must be from the background, in units of what noise does: lower finds more, and more that isn't
  /// there.
  double threshold = 2.5;
  /// The deepest shadow that is still background: what is left of the light, 0 to 1.
  double deepest_shadow = 0.6;
  /// Pieces smaller than this part of the picture are noise.
  double least_part = 0.0005;
  /// Without a clean plate: the background is what has been seen for most of so many frames.
  int memory_frames = 300;
};

/// What differs from the empty scene, seen by a camera that stands still.
///
/// The empty scene is a clean plate, or is learnt from the frames (a mixture of Gaussians for each pixel: Zivkovic,
/// "Improved adaptive Gaussian mixture model for background subtraction", 2004, OpenCV's MOG2). A pixel is background
/// if its colour is the empty scene's under some light that changes gently over the picture: brighter or darker by a
/// factor that is the same all around it (shadows: after Horprasert, Harwood and Davis, "A statistical approach for
/// real-time robust background subtraction and shadow detection", 1999). Borders are then found to the pixel by
/// KnownBackground. Found at a width of about 640 pixels, solved in the picture's own resolution.
class DifferenceMatte : public MatteEstimator {
 public:
  /// `clean`: a frame of the empty scene, of the plate's size; its colour coding may be another. Empty: learns.
  DifferenceMatte(std::optional<Frame> clean, const DifferenceOptions& options = {});
  ~DifferenceMatte() override;

  const char* name() const override { return "difference"; }
  bool knows_behind() const override { return true; }
  void estimate(const Frame& frame, Matte& matte) override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rinkaku::matte
