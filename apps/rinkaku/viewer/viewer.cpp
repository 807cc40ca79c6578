#include "apps/rinkaku/viewer/viewer.h"

#include <chrono>
#include <utility>

#include "pipeline/frame/error.h"

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
  std::lock_guard lock(mutex_);
  source_ = &source;
  line_ = &line;
  status_.stages = line.stage_names();
  status_.live = source.description().live;
  // A recording is played whole; of a camera only the newest picture counts.
  wait_for_window_ = !status_.live;
  letting_go_ = false;
}

std::optional<pipeline::SceneChange> Viewer::changed(std::int64_t /*frame*/) {
  std::lock_guard lock(mutex_);
  return std::exchange(ready_, std::nullopt);
}

void Viewer::refused(const std::string& why) {
  std::lock_guard lock(mutex_);
  status_.trouble = why;
}

void Viewer::finished(const pipeline::Work& work) {
  {
    std::unique_lock lock(mutex_);
    // A window that isn't drawn, e.g. minimised, must not stop the run for good.
    const auto taken = [this] { return !newest_ || letting_go_; };
    if (wait_for_window_) taken_.wait_for(lock, std::chrono::milliseconds(500), taken);
    newest_ = Shown{work.frame, work.stage_ms, work.pose.has_value()};
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

void Viewer::change(pipeline::Scene scene) {
  {
    std::lock_guard lock(mutex_);
    wish_ = std::move(scene);
  }
  wanted_.notify_one();
}

void Viewer::prepare() {
  std::unique_lock lock(mutex_);
  while (true) {
    wanted_.wait(lock, [this] { return ending_ || wish_; });
    if (ending_) return;
    pipeline::Scene scene = *std::exchange(wish_, std::nullopt);
    preparing_ = true;
    lock.unlock();
    std::optional<pipeline::SceneChange> ready;
    std::string trouble;
    try {
      pipeline::PreparedObjects objects = pipeline::prepare_objects(scene);
      ready.emplace(pipeline::SceneChange{std::move(scene), std::move(objects)});
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
