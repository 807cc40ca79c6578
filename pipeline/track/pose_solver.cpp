#include "pipeline/track/pose_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <glm/gtc/quaternion.hpp>
#include <opencv2/calib3d.hpp>

#include "pipeline/track/opencv_quiet.h"

namespace rinkaku::track {
namespace {

// A corner found to a tenth of a pixel and blurred or printed badly still lies within this; a marker read at a wrong
// place lies tens of pixels off.
constexpr double fits_px = 3.0;

RigidTransform to_transform(const cv::Mat& rotation_vector, const cv::Mat& translation) {
  const cv::Vec3d r(rotation_vector), t(translation);
  const glm::dvec3 axis(r[0], r[1], r[2]);
  const double angle = glm::length(axis);
  RigidTransform transform;
  if (angle > 1e-12) transform.rotation = glm::angleAxis(angle, axis / angle);
  transform.translation_m = {t[0], t[1], t[2]};
  return transform;
}

glm::dvec3 to_glm(const cv::Point3d& p) { return {p.x, p.y, p.z}; }

// The points' extent across the plane that fits them best, relative to their extent along it.
double flatness(const std::vector<cv::Point3d>& points) {
  const cv::Mat all(static_cast<int>(points.size()), 3, CV_64F, const_cast<cv::Point3d*>(points.data()));
  const cv::PCA axes(all, cv::noArray(), cv::PCA::DATA_AS_ROW);
  const double widest = axes.eigenvalues.at<double>(0), thinnest = axes.eigenvalues.at<double>(2);
  return widest > 0 ? std::sqrt(std::max(thinnest, 0.0) / widest) : 0;
}

}  // namespace

PoseSolver::PoseSolver(const CameraModel& camera)
    : camera_(camera),
      max_radius_(max_undistorted_radius(camera)),
      matrix_(camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1),
      distortion_(camera.distortion.begin(), camera.distortion.begin() + 12) {
  silence_opencv();
}

double PoseSolver::squared_error_px2(const RigidTransform& camera_from_world, const SeenMarker& marker) const {
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec3 p = camera_from_world * to_glm(marker.corners_m[i]);
    if (!(p.z > 0)) return std::numeric_limits<double>::infinity();
    const glm::dvec2 seen = to_pixels(camera_, distort(camera_, {p.x / p.z, p.y / p.z}));
    const double dx = seen.x - marker.corners_px[i].x, dy = seen.y - marker.corners_px[i].y;
    sum += dx * dx + dy * dy;
  }
  return sum;
}

double PoseSolver::rms_px(const RigidTransform& camera_from_world, const SeenMarker& marker) const {
  return std::sqrt(squared_error_px2(camera_from_world, marker) / 4);
}

std::vector<PoseCandidate> PoseSolver::solve_all(const std::vector<Undistorted>& markers) const {
  std::vector<cv::Point3d> world;
  std::vector<cv::Point2d> normalised, pixels;
  for (const Undistorted& marker : markers) {
    world.insert(world.end(), marker.seen->corners_m.begin(), marker.seen->corners_m.end());
    normalised.insert(normalised.end(), marker.normalised.begin(), marker.normalised.end());
    pixels.insert(pixels.end(), marker.seen->corners_px.begin(), marker.seen->corners_px.end());
  }
  // Markers glued to a wall are never flat to better than this; IPPE on a true plane is exact.
  const bool plane = flatness(world) < 1e-3;
  std::vector<PoseCandidate> found;
  try {
    std::vector<cv::Mat> rotations, translations;
    cv::solvePnPGeneric(world, normalised, cv::Matx33d::eye(), cv::noArray(), rotations, translations, false,
                        plane ? cv::SOLVEPNP_IPPE : cv::SOLVEPNP_SQPNP);
    for (std::size_t i = 0; i < rotations.size() && i < 2; ++i) {
      cv::solvePnPRefineLM(world, pixels, matrix_, distortion_, rotations[i], translations[i]);
      PoseCandidate candidate;
      candidate.camera_from_world = to_transform(rotations[i], translations[i]);
      for (const Undistorted& marker : markers) {
        candidate.squared_error_px2 += squared_error_px2(candidate.camera_from_world, *marker.seen);
      }
      candidate.corners = static_cast<int>(world.size());
      candidate.rms_px = std::sqrt(candidate.squared_error_px2 / candidate.corners);
      if (std::isfinite(candidate.rms_px)) found.push_back(candidate);
    }
  } catch (const cv::Exception&) {
    // Corners in a degenerate position (all on a line): nothing was seen that tells a pose.
    found.clear();
  }
  std::sort(found.begin(), found.end(),
            [](const PoseCandidate& a, const PoseCandidate& b) { return a.squared_error_px2 < b.squared_error_px2; });
  return found;
}

// The largest set of markers that fit a pose told by one of them, as RANSAC has it, but trying each.
std::vector<PoseSolver::Undistorted> PoseSolver::consensus(const std::vector<Undistorted>& markers) const {
  std::vector<Undistorted> best;
  // One marker's pose carries its own corner noise to far ones: allow more than at the end.
  constexpr double loose_px = 4 * fits_px;
  for (const Undistorted& one : markers) {
    for (const PoseCandidate& candidate : solve_all({one})) {
      std::vector<Undistorted> fitting;
      for (const Undistorted& other : markers) {
        if (rms_px(candidate.camera_from_world, *other.seen) < loose_px) fitting.push_back(other);
      }
      if (fitting.size() > best.size()) best = std::move(fitting);
    }
  }
  return best;
}

std::vector<PoseCandidate> PoseSolver::solve(const std::vector<SeenMarker>& seen) const {
  std::vector<Undistorted> markers;
  for (const SeenMarker& marker : seen) {
    Undistorted undistorted{&marker, {}};
    bool whole = true;
    for (std::size_t i = 0; i < 4 && whole; ++i) {
      const cv::Point2d& px = marker.corners_px[i];
      const auto p = undistort(camera_, to_normalised(camera_, {px.x, px.y}), max_radius_);
      whole = p.has_value();
      if (whole) undistorted.normalised[i] = {p->x, p->y};
    }
    if (whole) markers.push_back(undistorted);
  }
  if (markers.empty()) return {};

  const auto all_fit = [&](const std::vector<PoseCandidate>& found) {
    return !found.empty() && std::all_of(markers.begin(), markers.end(), [&](const Undistorted& marker) {
      return rms_px(found[0].camera_from_world, *marker.seen) < fits_px;
    });
  };
  std::vector<PoseCandidate> found = solve_all(markers);
  if (markers.size() == 1 || all_fit(found)) return found;

  if (markers.size() > 2) {
    markers = consensus(markers);
    if (markers.empty()) return {};
    found = solve_all(markers);
  }
  while (markers.size() > 1 && !found.empty() && !all_fit(found)) {
    const auto worst =
        std::max_element(markers.begin(), markers.end(), [&](const Undistorted& a, const Undistorted& b) {
          return rms_px(found[0].camera_from_world, *a.seen) < rms_px(found[0].camera_from_world, *b.seen);
        });
    markers.erase(worst);
    found = solve_all(markers);
  }
  return found;
}

}  // namespace rinkaku::track
