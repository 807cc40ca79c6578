#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/frame/frame.h"
#include "pipeline/frame/matte.h"
#include "pipeline/frame/tracked_pose.h"
#include "pipeline/passes/layer.h"
#include "pipeline/stage_times.h"

namespace rinkaku::pipeline {

/// What travels from stage to stage: everything of one frame, under the frame's number.
struct Work {
  Frame frame;
  std::optional<TrackedPose> pose;
  std::vector<Matte> mattes;          ///< of filmed things, nearest first
  std::vector<passes::Layer> slices;  ///< CG before, between and behind the mattes; one more than they are
  passes::Layer layer;                ///< what is to be laid over the plate

  /// Where CG is drawn: the layer itself, or slices of depth where something was filmed that it can be behind.
  std::span<passes::Layer> drawn() {
    return mattes.empty() ? std::span<passes::Layer>(&layer, 1) : std::span<passes::Layer>(slices);
  }
};

struct StageReport {
  std::string name;
  StageTimes times;
};

/// The stages of a run, grouped by the thread that they share:
///
///     decode -> track -> matte -> draw -> composite -> encode
///
/// joined by bounded queues, so that memory does not grow with the video. Drawing runs on the thread that calls run(),
/// as its GL context lives there; a group without stages has no thread. Frames keep their order.
class Line {
 public:
  using Step = std::function<void(Work&)>;
  enum class Group { Track, Matte, Draw, Composite, Encode };

  /// Stages of a group run in the order in which they were added. `name` is what reports call it.
  void add(Group group, const char* name, Step step);

  /// Gives the next frame's work, nothing after the last. Runs on the decoding thread; may throw.
  using Decode = std::function<std::optional<Work>()>;
  /// Runs until `decode` gives nothing more, then returns how many frames came through to the end. `drawn` is called on
  /// the calling thread after each frame's drawing. Rethrows what a stage threw, once all threads have ended.
  std::int64_t run(const Decode& decode, const std::function<void()>& drawn);

  /// Of each stage, in the order of adding, decoding first.
  std::vector<StageReport> reports() const;

 private:
  struct Stage {
    Group group;
    StageReport report;
    Step step;
    void operator()(Work& work);
  };
  std::vector<Stage*> stages_of(Group group);

  StageTimes decode_times_;
  std::deque<Stage> stages_;
};

/// Values on their way back from the end of the line to where they are made, with their memory.
template <class T>
class Spent {
 public:
  /// One whose memory may be used again, or an empty one.
  T take() {
    std::lock_guard lock(mutex_);
    if (values_.empty()) return {};
    T value = std::move(values_.back());
    values_.pop_back();
    return value;
  }
  void give_back(T value) {
    std::lock_guard lock(mutex_);
    values_.push_back(std::move(value));
  }

 private:
  std::mutex mutex_;
  std::vector<T> values_;
};

}  // namespace rinkaku::pipeline
