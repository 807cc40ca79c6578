#pragma once

#include <array>
#include <vector>

#include <opencv2/core.hpp>

#include "pipeline/frame/camera_model.h"
#include "pipeline/frame/rigid_transform.h"

namespace rinkaku::track {

/// A marker as it was seen: its corners in the board's frame (metres) and in the picture (pixels), in the same order.
struct SeenMarker {
  std::array<cv::Point3d, 4> corners_m;
  std::array<cv::Point2d, 4> corners_px;
};

/// One camera pose that explains what was seen.
struct PoseCandidate {
  RigidTransform camera_from_world;
  double squared_error_px2 = 0;  ///< summed over the corners used
  double rms_px = 0;             ///< root mean square distance of the corners used
  int corners = 0;
};

/// The camera's poses that explain the markers seen, best first: two for markers in one plane (a plane seen small or
/// far away looks nearly the same tilted either way), else one. Empty if none puts the markers in front of the camera.
///
/// Solved jointly on undistorted corners (planes by IPPE: Collins and Bartoli, Infinitesimal Plane-Based Pose
/// Estimation, 2014; others by SQPnP: Terzakis and Lourakis 2020), then refined by Levenberg-Marquardt on the distorted
/// pixels. Markers that do not fit what most others say are left out. Corners that the lens cannot have seen there are
/// left out too. Costs about 0.1 ms a call for a few markers.
class PoseSolver {
 public:
  explicit PoseSolver(const CameraModel& camera);

  std::vector<PoseCandidate> solve(const std::vector<SeenMarker>& markers) const;

 private:
  struct Undistorted {
    const SeenMarker* seen = nullptr;
    std::array<cv::Point2d, 4> normalised;
  };
  std::vector<PoseCandidate> solve_all(const std::vector<Undistorted>& markers) const;
  std::vector<Undistorted> consensus(const std::vector<Undistorted>& markers) const;
  double rms_px(const RigidTransform& camera_from_world, const SeenMarker& marker) const;
  double squared_error_px2(const RigidTransform& camera_from_world, const SeenMarker& marker) const;

  CameraModel camera_;
  double max_radius_ = 0;
  cv::Matx33d matrix_;
  std::vector<double> distortion_;
};

}  // namespace rinkaku::track
