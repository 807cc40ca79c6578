#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "pipeline/frame/rigid_transform.h"
#include "pipeline/track/tracker.h"

namespace rinkaku::track {

/// One line of a pose file. At least one of frame and time is known.
struct FilePose {
  std::optional<std::int64_t> frame;
  std::optional<double> time_s;
  RigidTransform world_from_camera;
};

/// Camera poses by frame number or time, in order. Metres; the camera looks along +z, x right, y down.
class PoseTable {
 public:
  /// Either every pose has a frame number or every pose has a time; in order, none twice (read_poses() sees to it).
  explicit PoseTable(std::vector<FilePose> poses);

  const std::vector<FilePose>& poses() const { return poses_; }
  bool by_frame() const { return by_frame_; }

  /// The pose of a frame: by its number where the file has numbers, else by time, between two lines by straight
  /// interpolation of the position and slerp of the rotation; `time_s` counts from the video's first frame. Empty for
  /// numbers the file lacks and times outside its span (half a microsecond of slack).
  std::optional<RigidTransform> world_from_camera(std::int64_t frame, double time_s) const;

 private:
  std::vector<FilePose> poses_;
  bool by_frame_ = false;
};

/// Reads a pose file: CSV with a header naming its columns (frame, time_s, tx, ty, tz, qx, qy, qz, qw in any order;
/// frame or time_s may be missing or empty throughout), or TUM's (timestamp tx ty tz qx qy qz qw; # starts a comment;
/// no header). Poses map the camera's frame to the world. Quaternions are brought to unit length. Lines may be in any
/// order: they are sorted. With both columns, the frame number decides. Throws Error (Input) naming file and line: no
/// poses, unknown or missing columns, a wrong number of fields, fields that are not finite numbers, a zero quaternion,
/// a frame or time given twice. Any thread.
PoseTable read_poses(const std::filesystem::path& file);

/// Gives each frame its pose from the table; none where the table has none. The table's time 0 is the video's first
/// frame, whose own time is `first_time_s`.
std::unique_ptr<Tracker> make_pose_file_tracker(PoseTable poses, double first_time_s = 0);

}  // namespace rinkaku::track
