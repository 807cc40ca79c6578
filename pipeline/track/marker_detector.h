#pragma once

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include <opencv2/aruco.hpp>

#include "pipeline/frame/camera_model.h"
#include "pipeline/track/edge_refiner.h"
#include "pipeline/track/soft_decoder.h"

namespace rinkaku::track {

/// A marker found in a picture; corners from the marker's own top left, clockwise as it was printed, in pixels.
struct Detection {
  int id = 0;
  std::array<cv::Point2d, 4> corners_px;

  double shortest_side_px() const;
};

/// How thorough the thorough search is, and how sure it must be of a marker whose bits can't be read.
struct SearchOptions {
  int widest_window_px = 23;  ///< of the adaptive threshold; wider ones find blurred outlines and cost time
  double least_score = 0.9;   ///< see SoftMatch
  double least_lead = 0.05;   ///< over every other marker of the dictionary
};

/// Finds markers of one dictionary in a camera's 8-bit grey pictures, corners to a tenth of a pixel; where a marker's
/// sides are too faint to be followed, to a fifth. Keeps scratch memory; one thread at a time.
class MarkerDetector {
 public:
  MarkerDetector(const std::string& dictionary, std::set<int> wanted, const CameraModel& camera);

  /// The shortest side of markers that detect_large() finds in pictures of this size.
  static double large_side_px(cv::Size picture) { return 32 + 0.02 * std::max(picture.width, picture.height); }

  /// Searches a smaller picture and refines on the full one (Romero-Ramirez et al., Speeded up detection of squared
  /// fiducial markers, 2018). Finds every wanted marker that can be read bit by bit and is large enough; in no order,
  /// the same id may come twice. The fast one.
  const std::vector<Detection>& detect_large(const cv::Mat& grey);

  /// Searches a part of the picture at full resolution with more thresholds; markers of some 15 px on, also blurred
  /// ones and ones that just touch the picture's edge.
  const std::vector<Detection>& detect_thoroughly(const cv::Mat& grey, const cv::Rect& part,
                                                  const SearchOptions& options);

 private:
  void add(const cv::Mat& grey, int id, const std::array<cv::Point2d, 4>& rough_px);
  void refine_corners(const cv::Mat& grey, double cell_px, std::array<cv::Point2d, 4>& corners_px);

  std::set<int> wanted_;
  cv::Ptr<cv::aruco::Dictionary> dictionary_;
  cv::Ptr<cv::aruco::DetectorParameters> quick_;
  cv::Ptr<cv::aruco::DetectorParameters> thorough_;
  SoftDecoder decoder_;
  EdgeRefiner refiner_;
  std::vector<std::vector<cv::Point2f>> corners_;
  std::vector<std::vector<cv::Point2f>> unread_;
  std::vector<int> ids_;
  std::vector<cv::Point2f> refined_;
  std::vector<Detection> found_;
};

}  // namespace rinkaku::track
