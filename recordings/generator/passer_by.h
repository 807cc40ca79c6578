#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "pipeline/frame/camera_model.h"
#include "recordings/generator/shot.h"
#include "recordings/generator/walker.h"

namespace rinkaku::recordings {

/// What the walker adds to one frame of the empty room.
struct PasserBy {
  cv::Mat3f light;   ///< premultiplied, linear
  cv::Mat1f alpha;   ///< the share of exposure and pixel the walker covers: the true matte
  cv::Mat1f shadow;  ///< what is left of the room's light behind
};

/// Draws the walker, at `start` at time 0, into pictures of a camera that stands still.
class PasserByRenderer {
 public:
  PasserByRenderer(const Room& room, const CameraModel& camera, const LensRays& rays,
                   const RigidTransform& world_from_camera, glm::vec3 start);
  PasserBy render(int frame, const ShotOptions& options) const;

 private:
  cv::Mat1f shadow(const Walker::Moment& moment, double time_s) const;
  std::vector<glm::vec3> light_on(const Walker::Moment& moment) const;

  const Room& room_;
  const CameraModel& camera_;
  RigidTransform camera_from_world_;
  glm::vec3 start_;
  Walker walker_;
  cv::Mat3f points_, normals_;  ///< of the room behind every second pixel
};

}  // namespace rinkaku::recordings
