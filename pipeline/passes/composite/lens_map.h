#pragma once

#include <memory>

#include "pipeline/frame/camera_model.h"
#include "pipeline/passes/layer.h"

namespace rinkaku::passes {

/// Puts the lens's distortion on CG that was drawn by a pinhole camera, so that it fits the plate as it was filmed.
///
/// For each pixel of the plate the map holds where it lies in the pinhole picture: same intrinsics, no distortion,
/// larger than the plate where the lens bends inwards. Lookups are bilinear. Pixels that no undistorted point reaches
/// (the distortion folds there) stay empty.
class LensMap {
 public:
  /// Computes the map for every pixel: about 0.3 microseconds each, once. Throws Error (Input) if the pinhole picture
  /// would be over four times the plate's size, or if no pixel of the plate shows any point.
  explicit LensMap(const CameraModel& camera);
  ~LensMap();
  LensMap(LensMap&&) noexcept;

  /// The part of the pinhole picture that the plate shows.
  PixelRect pinhole_rect() const;

  /// The part of the plate that a rectangle of the pinhole picture may touch.
  PixelRect plate_rect(const PixelRect& pinhole) const;

  /// `pinhole` as the lens shows it. `plate.rect` is set to plate_rect(pinhole.rect), its memory reused.
  void distort(const Layer& pinhole, Layer& plate) const;
  /// The same for depth, which is taken from the nearest pixel: between two surfaces there is nothing.
  void distort(const DepthLayer& pinhole, DepthLayer& plate) const;

 private:
  void shift(const PixelRect& plate, const PixelRect& pinhole) const;

  struct Tables;
  CameraModel camera_;
  std::unique_ptr<Tables> tables_;
};

}  // namespace rinkaku::passes
