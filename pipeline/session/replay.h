#pragma once

#include <memory>

#include "pipeline/pipeline.h"
#include "pipeline/session/log.h"
#include "pipeline/watcher.h"

namespace rinkaku::session {

/// The scene that a session began with, filmed by its plate.
pipeline::Scene scene_of(const Session& session);

/// Makes a render go as the session went: its frames get their own numbers and times, each is drawn with the pose it
/// was drawn with, and the scene changes where it changed. Renders of it are equal to the last bit to what was shown,
/// on the same machine and driver. `session` must outlive it.
class Replay final : public pipeline::Watcher {
 public:
  explicit Replay(const Session& session) : session_(session) {}

  std::unique_ptr<source::Source> through(std::unique_ptr<source::Source> source) override;
  std::unique_ptr<track::Tracker> tracked_by(std::unique_ptr<track::Tracker> tracker) override;
  std::optional<pipeline::SceneChange> changed(const Frame& frame) override;
  void refused(const std::string& why) override;

 private:
  const Session& session_;
  std::size_t changes_taken_ = 0;
};

}  // namespace rinkaku::session
