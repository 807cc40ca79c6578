#pragma once

#include <glm/mat4x4.hpp>

#include "pipeline/frame/camera_model.h"
#include "pipeline/frame/rigid_transform.h"
#include "pipeline/passes/layer.h"

namespace rinkaku::passes {

/// What a frame's CG is seen through, and when. Its lens distortion is not applied here but by LensMap.
struct View {
  CameraModel camera;
  RigidTransform camera_from_world;
  double time_s = 0;  ///< on the video's clock, from its first frame
};

/// The one place where OpenCV's camera (+z forward, y down, pixel centres at whole numbers) becomes GL's clip space.
///
/// The rectangle of the pinhole picture fills the viewport, its top row at window y = 0, so that reading pixels back
/// gives rows from the top. Depth is reversed and infinite: near_m / Z, 1 at the near plane and 0 infinitely far, for
/// glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE), depth function GL_GEQUAL and a float depth buffer; resolution is then
/// about 1e-7 of the distance everywhere. Clip w is the depth Z in metres.
glm::dmat4 clip_from_camera(const CameraModel& camera, const PixelRect& rect);

/// Nearer than this nothing is drawn.
inline constexpr double near_m = 1e-5;

}  // namespace rinkaku::passes
