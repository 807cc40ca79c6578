#include "apps/rinkaku/viewer/viewer.h"

#include <chrono>
#include <utility>

#include "apps/rinkaku/viewer/matte_view.h"
#include "pipeline/frame/error.h"
#include "pipeline/set_up.h"

namespace rinkaku::app {

Viewer::Viewer(std::function<void()> woken) : woken_(std::move(woken)), worker_([this] { prepare(); }) {}

Viewer::~Viewer() {
  {
    std::lock_guard lock(mutex_);
    ending_ = true;
  }
  wanted_.notify_all();
  worker_.join();
}

std::unique_ptr<source::Source> Viewer::through(std::unique_ptr<source::Source> source) {
  return std::make_unique<source::PlayedSource>(std::move(source), playback_);
}

void Viewer::started(const source::Source& source, const pipeline::Line& line) {
  if (session_) {
    // A run begun anew is another session.
    finish_session();
  } else if (session_plan_) {
    const source::Description& described = source.description();
    const SessionPlan plan = *std::exchange(session_plan_, std::nullopt);
    sink::Incoming incoming;
    incoming.format = described.format;
    incoming.time_base = described.time_base;
    incoming.frame_rate = described.frame_rate;
    incoming.variable_frame_rate = described.variable_frame_rate;
    session_ = std::make_unique<session::SessionWriter>(plan.folder, plan.scene, plan.text, incoming);
  }
  std::lock_guard lock(mutex_);
  source_ = &source;
  line_ = &line;
  status_.stages = line.stage_names();
  status_.live = source.description().live;
  status_.frames_per_s = pipeline::frames_per_s(source.description());
  // A recording is played whole; of a camera only the newest picture counts.
  wait_for_window_ = !status_.live;
  letting_go_ = false;
}

std::optional<pipeline::SceneChange> Viewer::changed(const Frame& frame) {
  std::optional<Ready> ready;
  session::SessionWriter* session = nullptr;
  {
    std::lock_guard lock(mutex_);
    ready = std::exchange(ready_, std::nullopt);
    session = session_.get();
  }
  if (!ready) return std::nullopt;
  // A repeated frame is part of no recording: the next one is the first.
  if (session) session->change(frame.number + (frame.repeated ? 1 : 0), ready->text);
  return std::move(ready->change);
}

void Viewer::drawn(const pipeline::Work& work) {
  if (session_ && !work.frame.repeated) session_->write(work.frame, work.pose);
}

void Viewer::keep_session(std::filesystem::path folder, std::filesystem::path scene, std::string text) {
  session_plan_ = SessionPlan{std::move(folder), std::move(scene), std::move(text)};
}

void Viewer::finish_session() {
  if (session_) session_->finish();
  session_.reset();
}

void Viewer::refused(const std::string& why) {
  std::lock_guard lock(mutex_);
  status_.trouble = why;
}

void Viewer::finished(const pipeline::Work& work) {
  Frame frame = look() == Look::Mattes ? matte_view(work, pool_) : work.frame;
  {
    std::unique_lock lock(mutex_);
    // A window that isn't drawn, e.g. minimised, must not stop the run for good.
    const auto taken = [this] { return !newest_ || letting_go_; };
    if (wait_for_window_) taken_.wait_for(lock, std::chrono::milliseconds(500), taken);
    if (newest_) ++status_.unshown;
    newest_ = Shown{std::move(frame), work.stage_ms, {}};
    if (work.pose) newest_->camera_from_world = work.pose->camera_from_world;
  }
  woken_();
}

std::optional<Viewer::Shown> Viewer::take_newest() {
  std::optional<Shown> shown;
  {
    std::lock_guard lock(mutex_);
    shown = std::exchange(newest_, std::nullopt);
  }
  taken_.notify_one();
  return shown;
}

void Viewer::change(pipeline::Scene scene, std::string text) {
  {
    std::lock_guard lock(mutex_);
    wish_ = Wish{std::move(scene), std::move(text), look_};
  }
  wanted_.notify_one();
}

void Viewer::look_at(Look look, pipeline::Scene scene, std::string text) {
  bool repaint = false;
  {
    std::lock_guard lock(mutex_);
    repaint = (look == Look::Curvature) != (look_ == Look::Curvature) && !scene.objects.empty();
    look_ = look;
  }
  if (repaint) {
    change(std::move(scene), std::move(text));
  } else {
    playback_.repeat();
  }
}

Viewer::Look Viewer::look() const {
  std::lock_guard lock(mutex_);
  return look_;
}

void Viewer::prepare() {
  std::unique_lock lock(mutex_);
  while (true) {
    wanted_.wait(lock, [this] { return ending_ || wish_; });
    if (ending_) return;
    Wish wish = *std::exchange(wish_, std::nullopt);
    preparing_ = true;
    lock.unlock();
    std::optional<Ready> ready;
    std::string trouble;
    try {
      const auto paint = wish.look == Look::Curvature ? pipeline::Paint::Curvature : pipeline::Paint::Scene;
      pipeline::PreparedObjects objects = pipeline::prepare_objects(wish.scene, paint);
      ready.emplace(Ready{{std::move(wish.scene), std::move(objects)}, std::move(wish.text)});
    } catch (const std::exception& error) {
      trouble = error.what();
    }
    lock.lock();
    preparing_ = false;
    status_.trouble = trouble;
    if (ready) ready_ = std::move(ready);
    lock.unlock();
    playback_.repeat();
    woken_();
    lock.lock();
  }
}

Viewer::Status Viewer::status() const {
  std::lock_guard lock(mutex_);
  Status status = status_;
  if (source_) status.health = source_->health();
  if (line_) status.dropped = line_->dropped();
  status.changing = preparing_ || wish_.has_value();
  return status;
}

void Viewer::ended() {
  std::lock_guard lock(mutex_);
  if (source_) status_.health = source_->health();
  if (line_) status_.dropped = line_->dropped();
  source_ = nullptr;
  line_ = nullptr;
}

void Viewer::let_go() {
  {
    std::lock_guard lock(mutex_);
    letting_go_ = true;
    // Prepared for the scene that ends.
    wish_.reset();
    ready_.reset();
  }
  taken_.notify_all();
}

}  // namespace rinkaku::app
