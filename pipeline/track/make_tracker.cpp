#include "pipeline/track/make_tracker.h"

#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>

#include "pipeline/track/board.h"
#include "pipeline/track/marker_tracker.h"
#include "pipeline/track/pose_file.h"
#include "pipeline/track/steady.h"

namespace rinkaku::track {
namespace {

struct Builder {
  const TrackOptions& options;
  const CameraModel& camera;

  std::unique_ptr<Tracker> operator()(const FromMarker& marker) const {
    return of_board(single_marker(options.where, marker.dictionary, marker.id, marker.size_m));
  }
  std::unique_ptr<Tracker> operator()(const FromBoard& from) const { return of_board(read_board(from.board)); }
  std::unique_ptr<Tracker> operator()(const LockedCamera& locked) const {
    return make_locked_tracker(options.where, locked);
  }

  std::unique_ptr<Tracker> operator()(const FromPoseFile& from) const {
    PoseTable poses = read_poses(from.poses);
    if (!options.smoothing) return make_pose_file_tracker(std::move(poses), from.first_time_s);
    SteadyOptions steady;
    steady.smoothing = options.smoothing;
    steady.hold_s = 0;
    steady.fade_s = 0;
    steady.blend_s = 0;
    steady.focal_px = camera.fx_px;
    // CG stands around the world's origin; how large it is, nobody says: take a quarter of the nearest distance.
    double nearest_m = 1e300;
    for (const FilePose& pose : poses.poses()) {
      nearest_m = std::min(nearest_m, glm::length(pose.world_from_camera.translation_m));
    }
    steady.radius_m = std::max(0.25 * nearest_m, 1e-3);
    return make_steady(make_pose_file_tracker(std::move(poses), from.first_time_s), steady);
  }

  std::unique_ptr<Tracker> of_board(const Board& board) const {
    SteadyOptions steady;
    steady.smoothing = options.smoothing;
    steady.hold_s = options.hold_s;
    steady.fade_s = options.fade_s;
    steady.focal_px = camera.fx_px;
    steady.centre_m = board.centre_m();
    steady.radius_m = board.radius_m();
    return make_steady(make_marker_tracker(board, camera), steady);
  }
};

}  // namespace

std::unique_ptr<Tracker> make_tracker(const TrackOptions& options, const CameraModel& camera) {
  return std::visit(Builder{options, camera}, options.from);
}

}  // namespace rinkaku::track
