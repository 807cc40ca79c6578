#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "pipeline/session/log.h"
#include "pipeline/source/playback.h"
#include "pipeline/watcher.h"

namespace rinkaku::app {

/// Where a run and a window meet: the run leaves its newest frame here, the window what it wants changed. The Watcher's
/// functions are for the run; all others are for the window's thread.
class Viewer final : public pipeline::Watcher {
 public:
  /// `woken` is called on the run's threads when there is something new.
  explicit Viewer(std::function<void()> woken);
  ~Viewer() override;

  std::unique_ptr<source::Source> through(std::unique_ptr<source::Source> source) override;
  void started(const source::Source& source, const pipeline::Line& line) override;
  std::optional<pipeline::SceneChange> changed(const Frame& frame) override;
  void refused(const std::string& why) override;
  void ended() override;
  void drawn(const pipeline::Work& work) override;
  void finished(const pipeline::Work& work) override;

  /// What the window shows.
  enum class Look {
    Picture,
    Mattes,     ///< see matte_view()
    Curvature,  ///< the picture, with objects painted with their curvature; it goes into recordings as well
  };

  /// A finished frame, once.
  struct Shown {
    Frame frame;
    std::array<float, pipeline::Work::most_stages> stage_ms{};
    std::optional<RigidTransform> camera_from_world;  ///< empty without a pose
  };
  std::optional<Shown> take_newest();

  /// Keeps the first run as a session in this folder; `text` is its scene file's. To be called before that run.
  void keep_session(std::filesystem::path folder, std::filesystem::path scene, std::string text);
  /// The session's last words; throws Error (Runtime) if it can't be finished.
  void finish_session();

  /// Draws this scene as soon as its objects are prepared, which another thread does; only the newest counts. `text` is
  /// its scene file's.
  void change(pipeline::Scene scene, std::string text);
  /// Shows it in another way from now on. `scene` and `text` as they are.
  void look_at(Look look, pipeline::Scene scene, std::string text);
  Look look() const;

  struct Status {
    std::vector<std::string> stages;  ///< of Shown::stage_ms
    source::Health health;
    pipeline::Line::Dropped dropped;
    std::int64_t unshown = 0;  ///< finished frames that a newer one took the place of before they were shown
    std::string trouble;       ///< why the newest change wasn't drawn; empty if it was
    bool live = false;
    double frames_per_s = 25;  ///< of the plate
    bool changing = false;     ///< a change is being prepared
  };
  Status status() const;

  source::Playback& playback() { return playback_; }

  /// Lets a run that waits for its frame to be taken go on, before it is told to stop.
  void let_go();

 private:
  void prepare();

  const std::function<void()> woken_;
  source::Playback playback_;

  mutable std::mutex mutex_;  // of all below
  std::condition_variable taken_, wanted_;
  std::optional<Shown> newest_;
  bool wait_for_window_ = true, letting_go_ = false, ending_ = false, preparing_ = false;
  struct Wish {
    pipeline::Scene scene;
    std::string text;
    Look look = Look::Picture;
  };
  struct Ready {
    pipeline::SceneChange change;
    std::string text;
  };
  Look look_ = Look::Picture;
  FramePool pool_;
  std::optional<Wish> wish_;
  std::optional<Ready> ready_;
  struct SessionPlan {
    std::filesystem::path folder, scene;
    std::string text;
  };
  std::optional<SessionPlan> session_plan_;
  std::unique_ptr<session::SessionWriter> session_;
  const source::Source* source_ = nullptr;
  const pipeline::Line* line_ = nullptr;
  Status status_;
  std::thread worker_;
};

}  // namespace rinkaku::app
