#include "pipeline/track/marker_tracker.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "pipeline/frame/error.h"
#include "pipeline/track/flip.h"
#include "pipeline/track/luma.h"
#include "pipeline/track/marker_detector.h"
#include "pipeline/track/opencv_quiet.h"
#include "pipeline/track/pose_solver.h"

namespace rinkaku::track {
namespace {

// A marker lost for longer than this may come back anywhere and either way tilted.
constexpr int forget_after_frames = 15;
// The thorough search of a whole picture costs as much as everything else together; once a marker is away, it may wait.
constexpr int search_every_frames = 4;

// A board's pose is good from so many markers on.
constexpr std::size_t enough_markers = 4;

// A blurred marker is believed more readily where it was a frame ago.
constexpr SearchOptions where_it_was{53, 0.75, 0.02}, anywhere{23, 0.9, 0.05};

std::set<int> ids(const Board& board) {
  std::set<int> result;
  for (const BoardMarker& marker : board.markers) result.insert(marker.id);
  return result;
}

class MarkerTracker final : public Tracker {
 public:
  MarkerTracker(const Board& board, const CameraModel& camera)
      : camera_(camera), detector_(board.dictionary, ids(board), camera), solver_(camera) {
    for (const BoardMarker& marker : board.markers) {
      auto& corners = corners_m_[marker.id];
      for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3& p = marker.corners_m[i];
        corners[i] = {p.x, p.y, p.z};
      }
    }
  }

  std::optional<TrackedPose> track(const Frame& frame) override {
    if (frame.format.width_px != camera_.width_px || frame.format.height_px != camera_.height_px) return {};
    // A detector that gives up on a picture has not seen a marker.
    const auto best = with_opencv([&] { return measure(luma(frame, scratch_)); },
                                  [](const std::string&) { return std::optional<PoseCandidate>(); });
    if (!best) {
      if (++missed_frames_ > forget_after_frames) {
        flip_.reset();
        last_seen_ = {};
      }
      return {};
    }
    missed_frames_ = 0;
    TrackedPose pose;
    pose.frame_number = frame.number;
    pose.camera_from_world = best->camera_from_world;
    pose.reprojection_rms_px = best->rms_px;
    return pose;
  }

 private:
  // What is cheap and likely first: small markers near their last place; then large ones anywhere; then, if these are
  // too few, everything.
  std::optional<PoseCandidate> measure(const cv::Mat& grey) {
    const cv::Rect whole(0, 0, grey.cols, grey.rows);
    const cv::Rect near = last_seen_ & whole;
    const bool near_first = near.area() > 0 && near.area() < whole.area() / 4 &&
                            smallest_side_px_ < 1.3 * MarkerDetector::large_side_px(grey.size());
    if (near_first) {
      gather(detector_.detect_thoroughly(grey, near, where_it_was));
      if (auto pose = solve()) return pose;
    }
    gather(detector_.detect_large(grey));
    if (seen_.size() >= std::min(enough_markers, corners_m_.size())) {
      if (auto pose = solve()) return pose;
    }
    const std::vector<SeenMarker> large = seen_;
    if (near.area() > 0 && !near_first) {
      gather(detector_.detect_thoroughly(grey, near, where_it_was));
    } else if (missed_frames_ <= forget_after_frames || missed_frames_ % search_every_frames == 0) {
      gather(detector_.detect_thoroughly(grey, whole, anywhere));
    }
    if (seen_.size() < large.size()) seen_ = large;
    return solve();
  }

  // The pose that explains what was gathered.
  std::optional<PoseCandidate> solve() {
    if (seen_.empty()) return {};
    std::vector<PoseCandidate> candidates = solver_.solve(seen_);
    // A true marker's corners fit a square to a pixel or two; what fits worse than a tenth of its side is none.
    smallest_side_px_ = 1e9;
    for (const SeenMarker& marker : seen_) {
      for (std::size_t i = 0; i < 4; ++i) {
        const double side_px = cv::norm(marker.corners_px[i] - marker.corners_px[(i + 1) % 4]);
        smallest_side_px_ = std::min(smallest_side_px_, side_px);
      }
    }
    const double limit_px = std::max(3.0, 0.1 * smallest_side_px_);
    std::erase_if(candidates, [&](const PoseCandidate& c) { return c.rms_px > limit_px; });
    if (candidates.empty()) return {};
    remember_where();
    return candidates[flip_.choose(candidates)];
  }

  // The detections that belong to the board. Of several with one id, the one nearest to where it was, or the largest.
  void gather(const std::vector<Detection>& detections) {
    seen_.clear();
    for (const auto& [id, corners] : corners_m_) {
      const Detection* best = nullptr;
      for (const Detection& detection : detections) {
        if (detection.id == id && (!best || likelier(detection, *best))) best = &detection;
      }
      if (!best) continue;
      seen_.push_back({corners, best->corners_px});
    }
  }

  bool likelier(const Detection& a, const Detection& b) const {
    if (last_seen_.area() == 0) return a.shortest_side_px() > b.shortest_side_px();
    const cv::Point2d middle = cv::Point2d(last_seen_.tl() + last_seen_.br()) * 0.5;
    const auto distance = [&](const Detection& d) {
      return cv::norm((d.corners_px[0] + d.corners_px[2]) * 0.5 - middle);
    };
    return distance(a) < distance(b);
  }

  // The part of the picture around what was seen, grown by its size each way: where it will be a frame later.
  void remember_where() {
    double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9;
    for (const SeenMarker& marker : seen_) {
      for (const cv::Point2d& p : marker.corners_px) {
        left = std::min(left, p.x);
        right = std::max(right, p.x);
        top = std::min(top, p.y);
        bottom = std::max(bottom, p.y);
      }
    }
    const double margin = 16 + 1.0 * std::max(right - left, bottom - top);
    last_seen_ = cv::Rect(cv::Point(cvFloor(left - margin), cvFloor(top - margin)),
                          cv::Point(cvCeil(right + margin), cvCeil(bottom + margin)));
  }

  CameraModel camera_;
  MarkerDetector detector_;
  PoseSolver solver_;
  FlipChooser flip_;
  std::map<int, std::array<cv::Point3d, 4>> corners_m_;
  cv::Mat scratch_;
  std::vector<SeenMarker> seen_;
  cv::Rect last_seen_;
  double smallest_side_px_ = 0;  // of the markers seen last
  int missed_frames_ = 0;
};

}  // namespace

std::unique_ptr<Tracker> make_marker_tracker(const Board& board, const CameraModel& camera) {
  if (board.markers.empty()) {
    throw input_error(board.name, "this board has no markers to track",
                      "use a grid, charuco or [[marker]] board; chessboards are for calibration");
  }
  return std::make_unique<MarkerTracker>(board, camera);
}

}  // namespace rinkaku::track
