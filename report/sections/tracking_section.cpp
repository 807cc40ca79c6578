#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <opencv2/aruco.hpp>
#include <opencv2/calib3d.hpp>

#include "pipeline/source/source.h"
#include "pipeline/track/board.h"
#include "pipeline/track/camera_file.h"
#include "pipeline/track/luma.h"
#include "pipeline/track/make_tracker.h"
#include "pipeline/track/opencv_marker.h"
#include "pipeline/track/pose_file.h"
#include "report/sections/recording.h"
#include "report/sections/sections.h"

namespace rinkaku::report {
namespace {

// What OpenCV alone gives: its detector with corners refined, and solvePnP over all of them.
class OpencvTracker : public track::Tracker {
 public:
  OpencvTracker(const track::Board& board, const CameraModel& camera)
      : board_(board),
        dictionary_(track::opencv_dictionary(board.name, board.dictionary)),
        parameters_(cv::aruco::DetectorParameters::create()),
        matrix_(camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1),
        distortion_(camera.distortion.begin(), camera.distortion.begin() + 8) {
    parameters_->cornerRefinementMethod = cv::aruco::CORNER_REFINE_SUBPIX;
  }
  std::optional<TrackedPose> track(const Frame& frame) override {
    std::vector<std::vector<cv::Point2f>> corners;
    std::vector<int> ids;
    cv::aruco::detectMarkers(track::luma(frame, scratch_), dictionary_, corners, ids, parameters_);
    std::vector<cv::Point2f> seen;
    std::vector<cv::Point3f> known;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      for (const track::BoardMarker& marker : board_.markers) {
        if (marker.id != ids[i]) continue;
        seen.insert(seen.end(), corners[i].begin(), corners[i].end());
        for (const glm::dvec3& c : marker.corners_m) {
          known.emplace_back(static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z));
        }
      }
    }
    cv::Vec3d turn, move;
    if (seen.empty() || !cv::solvePnP(known, seen, matrix_, distortion_, turn, move)) return std::nullopt;
    const double angle = cv::norm(turn);
    TrackedPose pose;
    const glm::dvec3 axis = angle > 0 ? glm::dvec3(turn[0], turn[1], turn[2]) / angle : glm::dvec3(0, 0, 1);
    pose.camera_from_world = {glm::angleAxis(angle, axis), {move[0], move[1], move[2]}};
    return pose;
  }

 private:
  const track::Board& board_;
  cv::Ptr<cv::aruco::Dictionary> dictionary_;
  cv::Ptr<cv::aruco::DetectorParameters> parameters_;
  cv::Matx33d matrix_;
  std::vector<double> distortion_;
  cv::Mat scratch_;
};

struct Way {
  std::string name;
  std::unique_ptr<track::Tracker> tracker;
  RigidTransform tracked_from_board{};  // a single marker's own frame is the world
  Stopwatch watch{};
  std::vector<double> corners_px{}, position_mm{}, rotation_deg{}, jitter_px{};
  std::optional<glm::dvec2> last_off_px{};
  int lost = 0;
};

glm::dvec2 seen_at(const CameraModel& camera, const RigidTransform& camera_from_board, const glm::dvec3& p) {
  const glm::dvec3 c = camera_from_board * p;
  return to_pixels(camera, distort(camera, {c.x / c.z, c.y / c.z}));
}

void compare(Way& way, const CameraModel& camera, const track::Board& board, const RigidTransform& found,
             const RigidTransform& truth) {
  double squares = 0;
  glm::dvec2 off(0);
  for (const track::BoardMarker& marker : board.markers) {
    for (const glm::dvec3& corner : marker.corners_m) {
      const glm::dvec2 d = seen_at(camera, found, corner) - seen_at(camera, truth, corner);
      squares += glm::dot(d, d), off += d;
    }
  }
  const double count = 4.0 * static_cast<double>(board.markers.size());
  off /= count;
  way.corners_px.push_back(std::sqrt(squares / count));
  way.position_mm.push_back(1e3 * glm::length(inverse(found).translation_m - inverse(truth).translation_m));
  const double cosine = std::abs(glm::dot(found.rotation, truth.rotation));
  way.rotation_deg.push_back(2 * std::acos(std::min(1.0, cosine)) * 180 / std::numbers::pi);
  if (way.last_off_px) way.jitter_px.push_back(glm::length(off - *way.last_off_px));
  way.last_off_px = off;
}

std::vector<Way> ways_of(const track::Board& board, const std::filesystem::path& board_file,
                         const CameraModel& camera) {
  std::vector<Way> ways;
  const track::BoardMarker& middle = board.markers[board.markers.size() / 2];
  glm::dvec3 centre(0);
  for (const glm::dvec3& corner : middle.corners_m) centre += corner / 4.0;
  const track::FromMarker marker{board.dictionary, middle.id, glm::length(middle.corners_m[1] - middle.corners_m[0])};
  for (const bool smoothed : {false, true}) {
    track::TrackOptions options;
    options.where = board.name;
    if (smoothed) options.smoothing = track::OneEuroOptions{};
    options.from = track::FromBoard{board_file};
    ways.push_back({smoothed ? "board, smoothed" : "board", track::make_tracker(options, camera)});
    options.from = marker;
    ways.push_back({smoothed ? "one marker, smoothed" : "one marker", track::make_tracker(options, camera)});
    ways.back().tracked_from_board.translation_m = -centre;
  }
  ways.push_back({"OpenCV, board", std::make_unique<OpencvTracker>(board, camera)});
  return ways;
}

Plot plot_of(const std::vector<Way>& ways, const char* title, const char* y, std::vector<double> Way::*values) {
  Plot plot;
  plot.title = title;
  plot.x.title = "time a frame, ms";
  plot.y.title = y;
  for (const Way& way : ways) {
    plot.series.push_back(
        {way.name, {timed_point(way.watch.timing().wall_ms, spread(way.*values).median, way.name)}, false});
  }
  return plot;
}

}  // namespace

Section tracking_section(const Settings& settings) {
  const track::PoseTable truth = track::read_poses(recorded(settings, "desk/poses.csv"));
  const CameraModel camera = track::read_camera(recorded(settings, "desk/camera.yml"));
  const auto board_file = recorded(settings, "desk/board.toml");
  const track::Board board = track::read_board(board_file);
  const auto video = source::open(recorded(settings, "desk/video.mp4").string());
  std::vector<Way> ways = ways_of(board, board_file, camera);
  const int frames = settings.quick ? 60 : 150;
  int seen = 0;
  for (auto frame = video->next(); frame && seen < frames; frame = video->next(), ++seen) {
    check_interrupted(settings);
    const auto true_pose = truth.world_from_camera(frame->number, 0);
    for (Way& way : ways) {
      std::optional<TrackedPose> pose;
      way.watch.run([&] { pose = way.tracker->track(*frame); });
      if (!pose || !true_pose) {
        way.last_off_px.reset(), ++way.lost;
        continue;
      }
      compare(way, camera, board, pose->camera_from_world * way.tracked_from_board, inverse(*true_pose));
    }
  }
  Section section;
  section.intro =
      "recordings/desk, " + std::to_string(seen) +
      " frames of 1280x720 filmed by hand around a board of twelve markers, whose true camera poses are known. "
      "The reprojection error is that of all of the board's corners, projected by the found pose and by the "
      "true one. Jitter is how far the mean of these errors moves from frame to frame.";
  section.table.columns = {{"method", "Method"},
                           {"reprojection_px", "Reprojection, px, median"},
                           {"reprojection_px_high", "upper quartile"},
                           {"position_mm", "Camera off, mm"},
                           {"rotation_deg", "Rotation, degrees"},
                           {"jitter_px", "Jitter, px a frame"},
                           {"frames_lost", "Frames lost"},
                           {"time_ms", "Time a frame, ms"},
                           {"time_low_ms", "low"},
                           {"time_high_ms", "high"},
                           {"cpu_ms", "CPU, ms"}};
  section.repetitions = seen;
  for (const Way& way : ways) {
    const Timing time = way.watch.timing();
    const Spread corners = spread(way.corners_px);
    section.table.rows.push_back({way.name, corners.median, corners.high, spread(way.position_mm).median,
                                  spread(way.rotation_deg).median, spread(way.jitter_px).median,
                                  static_cast<double>(way.lost), time.wall_ms.median, time.wall_ms.low,
                                  time.wall_ms.high, time.cpu_ms});
  }
  section.plots.push_back(
      plot_of(ways, "Where the board's corners land", "reprojection error, px (median)", &Way::corners_px));
  section.plots.push_back(plot_of(ways, "How much CG trembles", "jitter, px a frame (median)", &Way::jitter_px));
  section.plots[0].says =
      "A board pins the pose down better than one of its markers. On the front: " + front_names(section.plots[0]) + ".";
  section.plots[1].says =
      "This includes what smoothing lags behind the tremor of the hand, which is real motion here; smoothing pays "
      "where "
      "poses are noisier than the camera moves. On the front: " +
      front_names(section.plots[1]) + ".";
  return section;
}

}  // namespace rinkaku::report
