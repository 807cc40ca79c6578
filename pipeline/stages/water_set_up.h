#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "pipeline/frame/camera_model.h"
#include "pipeline/frame/rigid_transform.h"
#include "pipeline/scene/scene.h"
#include "water/brushes.h"
#include "water/painting.h"
#include "water/reference_picture.h"
#include "water/surface.h"

namespace rinkaku::pipeline {

/// From what a scene says of water to what water/ takes. All throw Error (Input) with the scene's line.

/// Poses that are known before the first frame: a camera that stands still, or a pose file's.
class KnownPoses {
 public:
  explicit KnownPoses(const Scene& scene);
  ~KnownPoses();
  /// The camera stands still.
  bool still() const { return still_.has_value(); }
  /// camera_from_world of a frame; empty if it is found only in the pictures, or the file has none.
  std::optional<RigidTransform> at(std::int64_t frame, double frames_per_s) const;

 private:
  struct File;
  std::optional<RigidTransform> still_;
  std::unique_ptr<File> file_;
};

water::Surface make_surface(const WaterSurfaceScene& scene, const KnownPoses& poses, double frames_per_s);

/// Arrows on the surface, one list a key frame.
std::vector<water::ArrowKey> make_arrows(const WaterSurfaceScene& scene, const water::Surface& surface,
                                         const CameraModel& camera, const KnownPoses& poses, double frames_per_s);

water::PaintingOptions painting_options(const WaterScene& water, const WaterSurfaceScene& surface, bool camera_still,
                                        double frames_per_s);

/// Where the user's brushes are used on a surface.
std::vector<glm::dvec2> brush_places(const WaterScene& water, const water::Surface& surface, const CameraModel& camera,
                                     const KnownPoses& poses, double frames_per_s);

/// The user's brushes; no layers if there are none.
water::BrushSheet read_brushes(const WaterScene& water);

/// Reads the panorama, if there is one.
water::MirrorOptions mirror_options(const WaterScene& water);

}  // namespace rinkaku::pipeline
