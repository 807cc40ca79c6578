#pragma once

#include <array>
#include <atomic>
#include <cstddef>
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
  bool run_up = false;  ///< shows later stages what was before the first frame asked for; ends with the drawing group
  std::vector<Matte> mattes;              ///< of filmed things, nearest first
  std::vector<passes::Layer> slices;      ///< CG before, between and behind the mattes; one more than they are
  std::vector<passes::LayerParts> parts;  ///< of what is drawn(), if --layers asks for them
  passes::Layer layer;                    ///< what is to be laid over the plate
  /// How long each stage took over this very frame, in the order of Line::stage_names(); decoding is the first.
  static constexpr std::size_t most_stages = 24;
  std::array<float, most_stages> stage_ms{};

  /// Where CG is drawn: the layer itself, or slices of depth where something was filmed that it can be behind.
  std::span<passes::Layer> drawn() {
    return mattes.empty() ? std::span<passes::Layer>(&layer, 1) : std::span<passes::Layer>(slices);
  }
};

/// How frames move along a line.
enum class Pace {
  EveryFrame,   ///< recordings: a full queue makes its producer wait
  NewestFrame,  ///< cameras: at most one frame waits before each thread, and gives way to a newer one
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
  using Drawn = std::function<void()>;
  /// Runs until `decode` gives nothing more, then returns how many frames came through to the end. `drawn` is called on
  /// the calling thread after each frame's drawing, run-up left out. Rethrows what a stage threw, once all threads have
  /// ended.
  std::int64_t run(const Decode& decode, const Drawn& drawn, Pace pace = Pace::EveryFrame);

  /// Decoding first, then the stages in the order of adding.
  std::vector<std::string> stage_names() const;
  /// Frames left out by Pace::NewestFrame so far: before they were finished, and finished ones that the last
  /// group was too slow for. Any thread.
  struct Dropped {
    std::int64_t before = 0;
    std::int64_t drawn = 0;
  };
  Dropped dropped() const { return {dropped_before_, dropped_drawn_}; }

  /// Of each stage, in the order of adding, decoding first.
  std::vector<StageReport> reports() const;

 private:
  struct Stage {
    Group group;
    StageReport report;
    Step step;
    std::size_t index;  // of Work::stage_ms
    void operator()(Work& work);
  };
  std::vector<Stage*> stages_of(Group group);

  StageTimes decode_times_;
  std::deque<Stage> stages_;
  std::atomic<std::int64_t> dropped_before_{0}, dropped_drawn_{0};
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
