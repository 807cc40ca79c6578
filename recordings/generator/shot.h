#pragma once

#include <functional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "pipeline/frame/camera_model.h"
#include "pipeline/frame/rigid_transform.h"
#include "recordings/generator/room.h"

namespace rinkaku::recordings {

/// How the camera takes one picture.
struct ShotOptions {
  double rate_hz = 30;
  double exposure_s = 1.0 / 60;  ///< centred on the frame's time
  int samples = 12;              ///< a pixel, each at its own time and place
  float softness_px = 0.44f;     ///< standard deviation of the lens' blur
  float lens_radius_m = 0.0006f;
  float focus_m = 0.58f;
};

/// Directions through the distorted lens, in the camera's frame with z = 1, for any place of the picture.
class LensRays {
 public:
  explicit LensRays(const CameraModel& camera);
  glm::vec2 at(float x_px, float y_px) const;

 private:
  static constexpr int margin = 4;
  int width_ = 0, height_ = 0;
  std::vector<glm::vec2> nodes_;
};

using Path = std::function<RigidTransform(double time_s)>;  ///< world_from_camera

/// Linear light of one frame, blurred by the camera's motion during the exposure. A function of its arguments only.
cv::Mat3f render(const Room& room, const CameraModel& camera, const LensRays& rays, const Path& world_from_camera,
                 const ShotOptions& options, int frame);

/// world_from_camera of a camera at `position` that looks at `target`; z is up in the world.
RigidTransform look_at(glm::dvec3 position, glm::dvec3 target, double roll = 0);

void write_camera(const std::string& file, const CameraModel& camera);
/// The poses at mid-exposure: frame,time_s,tx,ty,tz,qx,qy,qz,qw.
void write_poses(const std::string& file, const Path& world_from_camera, int frames, double rate_hz);
void write_text(const std::string& file, const std::string& text);

}  // namespace rinkaku::recordings
