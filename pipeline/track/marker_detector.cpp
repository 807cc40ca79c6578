#include "pipeline/track/marker_detector.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "pipeline/track/opencv_marker.h"
#include "pipeline/track/opencv_quiet.h"

namespace rinkaku::track {
namespace {

std::array<cv::Point2d, 4> shifted(const std::vector<cv::Point2f>& corners, cv::Point offset, int first = 0) {
  std::array<cv::Point2d, 4> result;
  for (std::size_t i = 0; i < 4; ++i) {
    result[i] = cv::Point2d(corners[(i + static_cast<std::size_t>(first)) % 4]) + cv::Point2d(offset);
  }
  return result;
}

}  // namespace

double Detection::shortest_side_px() const {
  double shortest = cv::norm(corners_px[3] - corners_px[0]);
  for (std::size_t i = 1; i < 4; ++i) shortest = std::min(shortest, cv::norm(corners_px[i] - corners_px[i - 1]));
  return shortest;
}

MarkerDetector::MarkerDetector(const std::string& dictionary, std::set<int> wanted, const CameraModel& camera)
    : wanted_(std::move(wanted)),
      dictionary_(opencv_dictionary({}, dictionary)),
      quick_(cv::aruco::DetectorParameters::create()),
      thorough_(cv::aruco::DetectorParameters::create()),
      decoder_(dictionary_),
      refiner_(camera) {
  silence_opencv();
  quick_->useAruco3Detection = true;
  quick_->minMarkerLengthRatioOriginalImg = 0.02F;  // 0.05 loses a third of the small markers, 0 gains no time
  quick_->cornerRefinementMethod = cv::aruco::CORNER_REFINE_SUBPIX;  // brings the corners up to full resolution
  // A wider range of threshold windows, looser outlines, also at the picture's edge: what blur and bold framing ask
  // for.
  thorough_->cornerRefinementMethod = cv::aruco::CORNER_REFINE_NONE;
  thorough_->polygonalApproxAccuracyRate = 0.06;
  thorough_->minMarkerDistanceRate = 0.02;
  thorough_->minDistanceToBorder = 0;
}

const std::vector<Detection>& MarkerDetector::detect_large(const cv::Mat& grey) {
  found_.clear();
  cv::aruco::detectMarkers(grey, dictionary_, corners_, ids_, quick_);
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    if (wanted_.count(ids_[i])) add(grey, ids_[i], shifted(corners_[i], {}));
  }
  return found_;
}

const std::vector<Detection>& MarkerDetector::detect_thoroughly(const cv::Mat& grey, const cv::Rect& part,
                                                                const SearchOptions& options) {
  found_.clear();
  const cv::Rect inside = part & cv::Rect(0, 0, grey.cols, grey.rows);
  if (inside.width < 16 || inside.height < 16) return found_;  // no room for a marker
  const cv::Mat view = grey(inside);
  // Relative to the part's longer side, as the detector has it: outlines of 40 px and more, in large pictures of
  // OpenCV's own 0.03 of it.
  thorough_->minMarkerPerimeterRate = std::clamp(40.0 / std::max(inside.width, inside.height), 0.03, 0.5);
  thorough_->adaptiveThreshWinSizeMax = options.widest_window_px;
  cv::aruco::detectMarkers(view, dictionary_, corners_, ids_, thorough_, unread_);
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    if (wanted_.count(ids_[i])) add(grey, ids_[i], shifted(corners_[i], inside.tl()));
  }

  // Of the quadrilaterals that were not read, the best one for each marker that was not found.
  std::set<int> missing = wanted_;
  for (const Detection& detection : found_) missing.erase(detection.id);
  std::map<int, std::pair<SoftMatch, std::size_t>> best;
  for (std::size_t i = 0; i < unread_.size() && !missing.empty(); ++i) {
    const auto match = decoder_.match(view, unread_[i], missing, options.least_score);
    if (!match || match->score - match->runner_up < options.least_lead) continue;
    const auto [at, first] = best.try_emplace(match->id, *match, i);
    if (!first && match->score > at->second.first.score) at->second = {*match, i};
  }
  for (const auto& [id, match] : best) add(grey, id, shifted(unread_[match.second], inside.tl(), match.first.turn));
  return found_;
}

void MarkerDetector::add(const cv::Mat& grey, int id, const std::array<cv::Point2d, 4>& rough_px) {
  Detection detection{id, rough_px};
  const double cell_px = detection.shortest_side_px() / (dictionary_->markerSize + 2);
  refine_corners(grey, cell_px, detection.corners_px);
  if (const auto corners = refiner_.refine(grey, detection.corners_px, cell_px)) {
    detection.corners_px = *corners;
  } else {
    // A marker cut off at the edge looks like a smaller one; only its sides tell.
    constexpr double border = 3;
    for (const cv::Point2d& p : rough_px) {
      if (p.x < border || p.y < border || p.x > grey.cols - 1 - border || p.y > grey.rows - 1 - border) return;
    }
  }
  found_.push_back(detection);
}

void MarkerDetector::refine_corners(const cv::Mat& grey, double cell_px, std::array<cv::Point2d, 4>& corners_px) {
  // The window must not reach the marker's next cell edge, or the corner is drawn towards it.
  const int half = std::clamp(static_cast<int>(std::lround(cell_px * 0.8)), 2, 7);
  refined_.assign(corners_px.begin(), corners_px.end());
  // cornerSubPix reads one pixel more around its window.
  const bool inside = std::all_of(refined_.begin(), refined_.end(), [&](const cv::Point2f& p) {
    return p.x > half + 2 && p.y > half + 2 && p.x < grey.cols - half - 3 && p.y < grey.rows - half - 3;
  });
  if (!inside) return;
  const cv::TermCriteria until(cv::TermCriteria::MAX_ITER + cv::TermCriteria::EPS, 30, 0.005);
  cv::cornerSubPix(grey, refined_, {half, half}, {-1, -1}, until);
  for (std::size_t c = 0; c < 4; ++c) {
    // A corner that ran away was no corner there; keep what was detected.
    if (cv::norm(cv::Point2d(refined_[c]) - corners_px[c]) <= half) corners_px[c] = refined_[c];
  }
}

}  // namespace rinkaku::track
