#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/frame/camera_model.h"
#include "pipeline/frame/frame.h"
#include "pipeline/frame/rigid_transform.h"
#include "pipeline/objects/drawing.h"
#include "pipeline/scene/scene.h"

namespace rinkaku::pipeline {

/// A scene's painted water: before a frame is drawn it finds the strokes, their colours taken from the filmed frame and
/// the mirrored objects, and hands them to its pass in the renderer. Lives on the thread of the GL context.
class WaterStage {
 public:
  /// Adds its pass to the drawing's renderer; the drawing must outlive the stage. `frames_per_s` of the
  /// plate. Throws Error (Input), with the scene's line, for what can't be painted.
  WaterStage(const Scene& scene, const CameraModel& camera, double frames_per_s, Drawing& drawing);
  ~WaterStage();
  WaterStage(WaterStage&&) noexcept;

  /// The strokes of this frame; `time_s` as in passes::View.
  void look(const Frame& frame, const RigidTransform& camera_from_world, double time_s);

  /// The first frame that has to be looked at for a frame to look as it does after all frames before it: strokes take
  /// their colours from what was mirrored up to four key frames ago, or some thirty frames where they follow.
  std::int64_t first_remembered(std::int64_t frame) const;

  /// Where the flow can't follow the arrows.
  const std::vector<std::string>& notices() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace rinkaku::pipeline
