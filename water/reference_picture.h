#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "pipeline/frame/camera_model.h"
#include "pipeline/frame/rigid_transform.h"
#include "water/surface.h"

namespace rinkaku::water {

/// A small picture: 8-bit sRGB-coded samples, rows from the top without gaps.
struct Picture {
  int width_px = 0, height_px = 0;
  int channels = 3;  ///< 3, or 4 with premultiplied alpha
  std::vector<std::uint8_t> samples;
  bool empty() const { return samples.empty(); }
};

/// What is mirrored where nothing else is: a picture all around, or a gradient.
struct Sky {
  glm::vec3 zenith{0.33f, 0.53f, 0.77f}, horizon{0.80f, 0.87f, 0.90f};  ///< sRGB-coded
  Picture panorama;  ///< equirectangular: its middle row is the horizon, its middle column lies in the world's +y
};

struct MirrorOptions {
  Sky sky;
  bool plate = true;                            ///< the filmed picture is mirrored where it shows what would be seen
  double surroundings_m = 20;                   ///< how far what is filmed is taken to be
  glm::vec3 water_colour{0.16f, 0.33f, 0.40f};  ///< of deep water, sRGB-coded
  double reflection = 0.9;                      ///< how much is mirrored at a grazing glance; less from above
  double gain = 1.0;                            ///< of what is mirrored
};

/// The picture that strokes take their colours from: the water without a wave, as the camera would see it, in a small
/// size. (Suzuki et al. 2004, 4.3.)
///
/// The ray from the eye is mirrored at the surface. Where the mirrored CG objects lie (drawn with all their passes from
/// the mirrored eye) theirs is the colour; else that of the filmed picture at the place where the mirrored ray meets a
/// sphere of `surroundings_m` around the camera; where that place is outside the picture, its nearest border fades over
/// to the sky. The more steeply the camera looks at the water, the more of the water's own colour is seen. Samples are
/// sRGB-coded, 0 to 1, mixed as they are, as painters mix. One thread.
class ReferencePicture {
 public:
  /// A pixel of it stands for `step_px` x `step_px` of the camera's pinhole picture; `mirrored` (by mirrored_eye(),
  /// null if there are no objects) may have another step.
  void paint(const Surface& surface, const CameraModel& camera, const RigidTransform& camera_from_world,
             const MirrorOptions& options, const Picture* plate, const Picture* mirrored, int mirrored_step_px,
             int step_px);

  /// Becomes the weighted sum of pictures of one size, as it lies between them in time.
  void mix(std::span<const ReferencePicture* const> pictures, std::span<const float> weights);

  /// At a pixel of the pinhole picture: bilinear; beyond the border as at it.
  glm::vec3 at(glm::dvec2 pixel) const;
  bool empty() const { return samples_.empty(); }
  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  const std::vector<glm::vec3>& samples() const { return samples_; }
  int step_px() const { return step_px_; }
  /// Another one after each paint() and mix().
  int version() const { return version_; }

 private:
  int width_px_ = 0, height_px_ = 0, step_px_ = 1, version_ = 0;
  std::vector<glm::vec3> samples_;
};

/// The camera that sees a mirrored scene: behind the surface, at the eye's mirror image. What it sees is turned left to
/// right: pixel (x, y) of the mirrored scene is its pixel (width - 1 - x, y).
struct MirroredEye {
  CameraModel camera;
  RigidTransform camera_from_world;
};
MirroredEye mirrored_eye(const Surface& surface, const CameraModel& camera, const RigidTransform& camera_from_world);

/// The same camera with a picture smaller by a whole number.
CameraModel smaller(const CameraModel& camera, int step_px);

}  // namespace rinkaku::water
