#include "pipeline/source/playback.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

namespace rinkaku::source {
namespace {

using namespace std::chrono_literals;

constexpr auto rest = 20ms;
// Later than this, the beat starts anew: what was missed is not hurried after.
constexpr std::int64_t most_late_ns = 50'000'000;

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace

void Playback::toggle_pause() {
  {
    std::lock_guard lock(mutex_);
    paused_ = !paused_;
  }
  changed_.notify_all();
}

bool Playback::paused() const {
  std::lock_guard lock(mutex_);
  return paused_;
}

void Playback::step() {
  {
    std::lock_guard lock(mutex_);
    paused_ = true;
    step_ = true;
  }
  changed_.notify_all();
}

void Playback::repeat() {
  {
    std::lock_guard lock(mutex_);
    repeat_ = paused_ || ended_;
  }
  changed_.notify_all();
}

bool Playback::ended() const {
  std::lock_guard lock(mutex_);
  return ended_;
}

Playback::Now Playback::next_move() {
  std::lock_guard lock(mutex_);
  if (std::exchange(repeat_, false)) return Now::Repeat;
  if (ended_) return Now::Rest;
  if (std::exchange(step_, false)) return Now::Step;
  return paused_ ? Now::Rest : Now::Run;
}

void Playback::wait() const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, rest);
}

void Playback::set_ended(bool ended) {
  std::lock_guard lock(mutex_);
  ended_ = ended;
}

PlayedSource::PlayedSource(std::unique_ptr<Source> source, Playback& playback)
    : source_(std::move(source)), playback_(playback) {
  playback_.set_ended(false);
}

void PlayedSource::stop_when(const std::atomic<bool>& stop) {
  stop_ = &stop;
  source_->stop_when(stop);
}

std::optional<Frame> PlayedSource::again() {
  std::optional<Frame> frame = last_;
  if (frame) frame->repeated = true;
  return frame;
}

void PlayedSource::wait_until_due(const Frame& frame) {
  const auto time_ns = static_cast<std::int64_t>(frame.time_s() * 1e9);
  if (!std::exchange(running_, true) || now_ns() - (start_ns_ + time_ns) > most_late_ns) start_ns_ = now_ns() - time_ns;
  while (!stopped() && now_ns() < start_ns_ + time_ns) {
    const std::chrono::nanoseconds left(start_ns_ + time_ns - now_ns());
    std::this_thread::sleep_for(std::min<std::chrono::nanoseconds>(left, rest));
  }
}

std::optional<Frame> PlayedSource::next() {
  const bool live = source_->description().live;
  while (!stopped()) {
    const Playback::Now now = playback_.next_move();
    if (now == Playback::Now::Repeat) {
      if (auto frame = again()) return frame;
      continue;
    }
    if (now == Playback::Now::Rest && !live) {
      running_ = false;
      playback_.wait();
      continue;
    }
    std::optional<Frame> frame = source_->next();
    if (!frame) {
      if (live || stopped()) return std::nullopt;
      playback_.set_ended(true);
      continue;
    }
    if (now == Playback::Now::Rest) continue;
    if (!live && now == Playback::Now::Run) wait_until_due(*frame);
    last_ = frame;
    return frame;
  }
  return std::nullopt;
}

}  // namespace rinkaku::source
