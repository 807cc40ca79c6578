#include "pipeline/line.h"

#include <cassert>
#include <chrono>
#include <exception>
#include <thread>
#include <utility>

#include "pipeline/bounded_queue.h"

namespace rinkaku::pipeline {
namespace {

using Clock = std::chrono::steady_clock;
using Queue = BoundedQueue<Work>;

// Deep enough to even out slow frames (four lose 3 % of the frame rate on two cores, twelve gain nothing), shallow
// enough that memory stays small: at 1080p a frame is 3 MB.
constexpr std::size_t queue_frames = 8;
// Live, every waiting frame is latency; but an encoder may hiccup for a moment without losing one.
constexpr std::size_t live_queue_frames = 1, live_encode_frames = 8;

float milliseconds(Clock::duration duration) { return std::chrono::duration<float, std::milli>(duration).count(); }

// Worker threads that are joined on the way out, whichever way that is; closing the queues lets them go.
class Threads {
 public:
  explicit Threads(std::vector<Queue*> queues) : queues_(std::move(queues)) {}
  ~Threads() {
    for (Queue* queue : queues_) queue->abandon();
    join();
  }
  template <typename Body>
  void start(Body body) {
    threads_.emplace_back(std::move(body));
  }
  void join() {
    for (std::thread& t : threads_) t.join();
    threads_.clear();
  }

 private:
  std::vector<Queue*> queues_;
  std::vector<std::thread> threads_;
};

void decode_all(const Line::Decode& decode, StageTimes& times, Queue& out) {
  try {
    while (true) {
      const auto start = Clock::now();
      std::optional<Work> work = decode();
      if (!work) break;
      const auto took = Clock::now() - start;
      if (!work->run_up) times.add(took);
      work->stage_ms[0] = milliseconds(took);
      if (!out.push(std::move(*work))) break;
    }
    out.end();
  } catch (...) {
    out.end(std::current_exception());
  }
}

enum class RunUp { HandOn, End };

// Takes from one queue, runs the stages, hands on. Whatever is thrown goes to the consumer and stops the producer.
template <typename Stages>
void hand_on(Queue& in, const Stages& stages, Queue& out, RunUp run_up = RunUp::HandOn,
             const std::function<void()>& each = {}) {
  try {
    while (std::optional<Work> work = in.pop()) {
      for (auto* stage : stages) (*stage)(*work);
      if (work->run_up && run_up == RunUp::End) continue;
      if (!out.push(std::move(*work))) break;
      if (each) each();
    }
    out.end();
  } catch (...) {
    out.end(std::current_exception());
  }
  in.abandon();
}

// The last of the line: returns what any stage threw.
template <typename Stages>
std::exception_ptr take_in(Queue& in, const Stages& stages, std::int64_t& frames) {
  std::exception_ptr failure;
  try {
    while (std::optional<Work> work = in.pop()) {
      for (auto* stage : stages) (*stage)(*work);
      ++frames;
    }
  } catch (...) {
    failure = std::current_exception();
  }
  in.abandon();
  return failure;
}

}  // namespace

void Line::Stage::operator()(Work& work) {
  const auto start = Clock::now();
  step(work);
  const auto took = Clock::now() - start;
  if (!work.run_up) report.times.add(took);
  work.stage_ms[index] = milliseconds(took);
}

void Line::add(Group group, const char* name, Step step) {
  assert(stages_.size() + 1 < Work::most_stages);
  stages_.push_back({group, {name, {}}, std::move(step), stages_.size() + 1});
}

std::vector<Line::Stage*> Line::stages_of(Group group) {
  std::vector<Stage*> found;
  for (Stage& stage : stages_) {
    if (stage.group == group) found.push_back(&stage);
  }
  return found;
}

std::int64_t Line::run(const Decode& decode, const Drawn& drawn_one, Pace pace) {
  const auto track = stages_of(Group::Track), matte = stages_of(Group::Matte), draw = stages_of(Group::Draw);
  const auto composite = stages_of(Group::Composite), encode = stages_of(Group::Encode);
  const bool newest = pace == Pace::NewestFrame;
  const std::size_t waiting = newest ? live_queue_frames : queue_frames;
  const WhenFull live_full = newest ? WhenFull::DropOldest : WhenFull::Wait;
  Queue decoded(waiting, live_full, dropped_before_), tracked(waiting, live_full, dropped_before_),
      matted(waiting, live_full, dropped_before_), drawn(waiting, live_full, dropped_before_);
  Queue finished(newest ? live_encode_frames : queue_frames, live_full, dropped_drawn_);
  Queue& to_matte = track.empty() ? decoded : tracked;
  Queue& to_draw = matte.empty() ? to_matte : matted;
  Queue& from_draw = composite.empty() ? finished : drawn;
  std::int64_t frames = 0;
  std::exception_ptr failure;  // of any stage: exceptions travel down the queues and end here
  {
    Threads threads({&decoded, &tracked, &matted, &drawn, &finished});
    threads.start([&] { decode_all(decode, decode_times_, decoded); });
    if (!track.empty()) threads.start([&] { hand_on(decoded, track, tracked); });
    if (!matte.empty()) threads.start([&] { hand_on(to_matte, matte, matted); });
    if (!composite.empty()) threads.start([&] { hand_on(drawn, composite, finished); });
    threads.start([&] { failure = take_in(finished, encode, frames); });
    hand_on(to_draw, draw, from_draw, RunUp::End, drawn_one);
    threads.join();
  }
  if (failure) std::rethrow_exception(failure);
  return frames;
}

std::vector<std::string> Line::stage_names() const {
  std::vector<std::string> names{"decode"};
  for (const Stage& stage : stages_) names.push_back(stage.report.name);
  return names;
}

std::vector<StageReport> Line::reports() const {
  std::vector<StageReport> all{{"decode", decode_times_}};
  for (const Stage& stage : stages_) all.push_back(stage.report);
  return all;
}

}  // namespace rinkaku::pipeline
