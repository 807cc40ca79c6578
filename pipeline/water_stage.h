#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "pipeline/frame/camera_model.h"
#include "pipeline/frame/frame.h"
#include "pipeline/frame/rigid_transform.h"
#include "pipeline/passes/layer_renderer.h"
#include "pipeline/scene/scene.h"
#include "water/section.h"

namespace rinkaku::pipeline {

/// A scene's painted water: before a frame is drawn it finds the strokes, their colours taken from the filmed frame and
/// the mirrored objects, and hands them to its pass in the renderer. Lives on the thread of the GL context.
class WaterStage {
 public:
  /// Adds its pass to `renderer`, which must outlive the stage. `solids` stand in the water; `frames_per_s` of the
  /// plate. Throws Error (Input), with the scene's line, for what can't be painted.
  WaterStage(const Scene& scene, const CameraModel& camera, double frames_per_s, std::span<const water::Solid> solids,
             passes::LayerRenderer& renderer);
  ~WaterStage();
  WaterStage(WaterStage&&) noexcept;

  /// The strokes of this frame.
  void look(const Frame& frame, const RigidTransform& camera_from_world);

  /// Where the flow can't follow the arrows.
  const std::vector<std::string>& notices() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace rinkaku::pipeline
