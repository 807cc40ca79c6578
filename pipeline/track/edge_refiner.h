#pragma once

#include <array>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "pipeline/frame/camera_model.h"

namespace rinkaku::track {

/// Finds a marker's corners as the meeting points of its four sides.
///
/// Each side is a straight line through some dozen edge points, found to a fraction of a pixel where brightness rises
/// most from the marker's black outwards, and brought to the undistorted picture first. Blur, which rounds corners off
/// and draws them inwards, leaves sides where they are; a corner may lie outside the picture. Keeps scratch memory.
class EdgeRefiner {
 public:
  explicit EdgeRefiner(const CameraModel& camera);

  /// The corners in pixels from rough ones (clockwise, black inside), right to a third of `cell_px`, a cell's width.
  /// Empty if a side shows no edge or the corners would move by more than a cell.
  std::optional<std::array<cv::Point2d, 4>> refine(const cv::Mat& grey, const std::array<cv::Point2d, 4>& rough,
                                                   double cell_px);

 private:
  // A line a x + b y = c with a^2 + b^2 = 1, in undistorted normalised coordinates.
  struct Line {
    double a = 0, b = 0, c = 0;
  };
  std::optional<Line> side(const cv::Mat& grey, const cv::Point2d& from, const cv::Point2d& to, double reach_px);
  std::optional<Line> fit(double outlier);

  CameraModel camera_;
  double max_radius_;
  std::vector<double> profile_;
  std::vector<glm::dvec2> points_;
};

}  // namespace rinkaku::track
