#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "pipeline/frame/camera_model.h"
#include "pipeline/track/locked.h"
#include "pipeline/track/one_euro.h"
#include "pipeline/track/tracker.h"

namespace rinkaku::track {

/// What a scene's [track] says, one for one.
struct FromMarker {
  std::string dictionary;  ///< see dictionary.h
  int id = 0;
  double size_m = 0;
};
struct FromBoard {
  std::filesystem::path board;
};
struct FromPoseFile {
  std::filesystem::path poses;
  double first_time_s = 0;  ///< of the video's first frame, which is time 0 of the file
};

struct TrackOptions {
  std::variant<FromMarker, FromBoard, FromPoseFile, LockedCamera> from;
  std::string where;  ///< the scene file, for messages on a marker or a locked camera
  std::optional<OneEuroOptions>
      smoothing;        ///< for a pose file given only if it is wanted; no effect on a locked camera
  double hold_s = 0.3;  ///< for markers and boards only: what a pose file lacks has no pose, at once
  double fade_s = 0.3;
};

/// Builds the tracker, reading the board or pose file. Throws Error (Input) naming the file, or `where`.
std::unique_ptr<Tracker> make_tracker(const TrackOptions& options, const CameraModel& camera);

}  // namespace rinkaku::track
