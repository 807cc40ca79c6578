#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/line.h"
#include "pipeline/objects/drawing.h"
#include "pipeline/scene/scene.h"
#include "pipeline/source/source.h"
#include "pipeline/track/tracker.h"

namespace rinkaku::pipeline {

/// Another scene from a frame on. Only its objects, light and water may differ from the scene that the run began with.
struct SceneChange {
  Scene scene;
  PreparedObjects objects;  ///< of that scene
};

/// Who looks on while a scene is rendered, and may change it: a window, a session's log. Every function has its thread;
/// what it throws ends the run.
class Watcher {
 public:
  virtual ~Watcher() = default;

  /// Calling thread, before anything else is made: may put something between the source and the run, e.g. a clock.
  virtual std::unique_ptr<source::Source> through(std::unique_ptr<source::Source> source) { return source; }

  /// Calling thread, if anything is tracked: may track in another way.
  virtual std::unique_ptr<track::Tracker> tracked_by(std::unique_ptr<track::Tracker> tracker) { return tracker; }

  /// Calling thread, once all is set up. `line` outlives the run; its stages don't change any more.
  virtual void started(const source::Source& /*source*/, const Line& /*line*/) {}

  /// Drawing thread, before this frame is drawn: the scene from now on, if it changed.
  virtual std::optional<SceneChange> changed(const Frame& /*frame*/) { return std::nullopt; }

  /// Drawing thread: what changed() gave can't be drawn, the scene before it stays.
  virtual void refused(const std::string& /*why*/) {}

  /// Calling thread, however the run ended, if it was started: what started() gave is about to go.
  virtual void ended() {}

  /// Compositing thread, with the frame still as it was filmed, its pose and its CG.
  virtual void drawn(const Work& /*work*/) {}

  /// Compositing thread, with the finished frame, which is shared and not to be written. May wait to keep a pace.
  virtual void finished(const Work& /*work*/) {}
};

}  // namespace rinkaku::pipeline
