#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/frame/frame.h"
#include "pipeline/frame/tracked_pose.h"
#include "pipeline/sink/sink.h"

namespace rinkaku::session {

/// A live session as it was: a folder with plate.mkv, the frames as the camera gave them, lossless, and session.jsonl,
/// a line of JSON for the scene at the start, for each frame, and for each change of the scene. docs/live.md describes
/// it.
struct LoggedFrame {
  std::int64_t number = 0;  ///< the source's; gaps are frames that were dropped
  std::int64_t pts = 0, duration = 0;
  Rational time_base{1, 1};
  std::int64_t captured_ns = 0;
  std::optional<TrackedPose> pose;  ///< as it was drawn with, to the last bit
};
struct LoggedChange {
  std::int64_t from_frame = 0;  ///< the first frame drawn so
  std::string text;             ///< the whole scene file
};
struct Session {
  std::filesystem::path folder;
  std::filesystem::path scene;  ///< where the scene file lay; paths in it start there
  std::string text;             ///< the scene file at the start
  std::vector<LoggedFrame> frames;
  std::vector<LoggedChange> changes;

  std::filesystem::path plate() const { return folder / "plate.mkv"; }
};

/// Whether this is a session's folder.
bool is_session(const std::filesystem::path& folder);

/// Reads a session's log; a last line that was cut off is left out. Throws Error (Input), naming file and line.
Session read_session(const std::filesystem::path& folder);

/// Writes a session while it happens. What was written stays readable if the program is killed. change() may be called
/// on another thread than write(), not at the same time as itself.
class SessionWriter {
 public:
  /// Makes the folder, which must not exist. Throws Error: Input if that fails, or if frames of the format can't be
  /// kept without loss.
  SessionWriter(const std::filesystem::path& folder, const std::filesystem::path& scene, const std::string& text,
                const sink::Incoming& incoming);
  ~SessionWriter();

  void write(const Frame& frame, const std::optional<TrackedPose>& pose);
  void change(std::int64_t from_frame, const std::string& text);
  void finish();

 private:
  class Lines;
  std::unique_ptr<Lines> lines_;
  std::unique_ptr<sink::Sink> plate_;
  bool begun_ = false;
};

}  // namespace rinkaku::session
