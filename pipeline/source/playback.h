#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>

#include "pipeline/source/source.h"

namespace rinkaku::source {

/// The hand on the tape: starts and stops a played source. Any thread.
class Playback {
 public:
  void toggle_pause();
  bool paused() const;
  /// One frame further, then pause.
  void step();
  /// While it rests: the last frame once more, since what is drawn on it changed.
  void repeat();
  /// A recording was shown to its end.
  bool ended() const;

 private:
  friend class PlayedSource;
  enum class Now { Run, Rest, Step, Repeat };
  Now next_move();
  void wait() const;
  void set_ended(bool ended);

  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  bool paused_ = false, step_ = false, repeat_ = false, ended_ = false;
};

/// Gives a source's frames at the beat they were filmed at, as `playback` lets it: a recording late is not hurried, a
/// camera never waited for. At a recording's end the last frame stays until `stop`; a camera's frames pass unseen while
/// it rests. `playback` must outlive it.
class PlayedSource final : public Source {
 public:
  PlayedSource(std::unique_ptr<Source> source, Playback& playback);

  const Description& description() const override { return source_->description(); }
  std::optional<Frame> next() override;
  void stop_when(const std::atomic<bool>& stop) override;
  Health health() const override { return source_->health(); }
  std::string damage() const override { return source_->damage(); }

 private:
  bool stopped() const { return stop_ && *stop_; }
  std::optional<Frame> again();
  void wait_until_due(const Frame& frame);

  std::unique_ptr<Source> source_;
  Playback& playback_;
  const std::atomic<bool>* stop_ = nullptr;
  std::optional<Frame> last_;
  std::int64_t start_ns_ = 0;  // when a frame of time 0 would have been due
  bool running_ = false;
};

}  // namespace rinkaku::source
