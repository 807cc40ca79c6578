#include "pipeline/pipeline.h"

#include <chrono>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "pipeline/bounded_queue.h"
#include "pipeline/drawing.h"
#include "pipeline/frame/error.h"
#include "pipeline/passes/composite/blend.h"
#include "pipeline/passes/composite/lens_map.h"
#include "pipeline/passes/composite/straight_alpha.h"
#include "pipeline/passes/layer_renderer.h"
#include "pipeline/set_up.h"
#include "pipeline/sink/sink.h"
#include "pipeline/source/source.h"
#include "pipeline/track/tracker.h"

namespace rinkaku::pipeline {
namespace {

// What travels from stage to stage: everything of one frame, under the frame's number.
struct Work {
  Frame frame;
  std::optional<TrackedPose> pose;
  passes::Layer layer;
};
using Queue = BoundedQueue<Work>;

// Layers go back from where they are laid over the plate to where they are drawn, with their memory.
class SpentLayers {
 public:
  passes::Layer take() {
    std::lock_guard lock(mutex_);
    if (layers_.empty()) return {};
    passes::Layer layer = std::move(layers_.back());
    layers_.pop_back();
    return layer;
  }
  void give_back(passes::Layer layer) {
    std::lock_guard lock(mutex_);
    layers_.push_back(std::move(layer));
  }

 private:
  std::mutex mutex_;
  std::vector<passes::Layer> layers_;
};

// Deep enough to even out single slow frames, shallow enough that memory stays small: at 1080p a frame is 3 MB.
constexpr std::size_t queue_frames = 4;

// One stage's work on one frame, timed.
class Step {
 public:
  using Run = std::function<void(Work&)>;
  Step(StageReport& report, Run run) : report_(report), run_(std::move(run)) {}
  void operator()(Work& work) {
    const auto start = std::chrono::steady_clock::now();
    run_(work);
    report_.times.add(std::chrono::steady_clock::now() - start);
  }

 private:
  StageReport& report_;
  Run run_;
};

// The stages that run, by thread.
struct Line {
  std::deque<StageReport> reports;  // a deque: steps keep references
  std::vector<Step> track, draw, composite, encode;
  StageReport& report(const char* name) { return reports.emplace_back(StageReport{name, {}}); }
};

// Takes from one queue, runs the steps, hands on. Whatever is thrown goes to the consumer and stops the producer.
void hand_on(Queue& in, std::vector<Step>& steps, Queue& out, const std::function<void()>& each = {}) {
  try {
    while (std::optional<Work> work = in.pop()) {
      for (Step& step : steps) step(*work);
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
std::exception_ptr take_in(Queue& in, std::vector<Step>& steps, std::int64_t& frames) {
  std::exception_ptr failure;
  try {
    while (std::optional<Work> work = in.pop()) {
      for (Step& step : steps) step(*work);
      ++frames;
    }
  } catch (...) {
    failure = std::current_exception();
  }
  in.abandon();
  return failure;
}

void decode(source::Source& source, const RenderOptions& options, const std::atomic<bool>& stop, StageReport& report,
            Queue& out) {
  try {
    while (!stop) {
      const auto start = std::chrono::steady_clock::now();
      std::optional<Frame> frame = source.next();
      if (!frame || frame->number >= options.end_frame) break;
      report.times.add(std::chrono::steady_clock::now() - start);
      if (frame->number < options.first_frame) continue;
      if (!out.push({std::move(*frame), std::nullopt, {}})) break;
    }
    out.end();
  } catch (...) {
    out.end(std::current_exception());
  }
}

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

}  // namespace

RenderReport render(const Prepared& prepared, const RenderOptions& options, const std::atomic<bool>& stop,
                    const Progress& progress) {
  const Scene& scene = prepared.scene;
  const Plan& plan = prepared.plan;
  RenderReport result;
  result.output = scene.output.path;

  // Set-up, from the source to the sink: whatever is wrong is found before anything is written.
  const std::unique_ptr<source::Source> source = open_source(prepared);
  const source::Description& described = source->description();
  result.width_px = described.format.width_px;
  result.height_px = described.format.height_px;
  if (!described.notice.empty()) result.notices.push_back(described.notice);

  Line line;
  StageReport& decode_report = line.report("decode");
  std::unique_ptr<track::Tracker> tracker;
  if (plan.runs("track")) {
    tracker = make_tracker(prepared, described);
    line.track.emplace_back(line.report("track"), [&](Work& work) { work.pose = tracker->track(work.frame); });
  }

  std::optional<passes::LensMap> lens;
  if (plan.runs("lens")) lens.emplace(*prepared.camera);
  std::optional<Drawing> drawing;
  SpentLayers spent;
  if (plan.runs("draw")) {
    drawing.emplace(
        make_drawing(scene, lens ? lens->pinhole_rect() : passes::PixelRect{0, 0, result.width_px, result.height_px}));
    result.notices.insert(result.notices.end(), drawing->notices.begin(), drawing->notices.end());
    line.draw.emplace_back(line.report("draw"), [&](Work& work) {
      work.layer = spent.take();
      work.layer.rect = {};
      if (!work.pose || work.pose->opacity <= 0) return;
      ++result.posed_frames;
      drawing->renderer->draw({*prepared.camera, work.pose->camera_from_world}, work.layer);
    });
  }
  passes::Layer distorted;
  if (lens) {
    line.composite.emplace_back(line.report("lens"), [&](Work& work) {
      lens->distort(work.layer, distorted);
      std::swap(work.layer, distorted);
    });
  }
  FramePool pool;
  passes::Blender blender;
  auto opacity = [](const Work& work) { return work.pose ? work.pose->opacity : 0.0; };
  const Output output = open_output(prepared, options, described);
  Output layers;
  if (plan.runs("layers")) {
    layers = open_layers(prepared, options, described);
    line.composite.emplace_back(line.report("layers"), [&](Work& work) {
      layers.sink->write(straight_alpha_frame(work.frame, work.layer, opacity(work), pool));
    });
  }
  if (plan.runs("composite")) {
    require_blendable(described);
    line.composite.emplace_back(line.report("composite"), [&](Work& work) {
      if (work.layer.rect.empty()) return;
      pool.make_writable(work.frame);
      blender.blend(work.frame, work.layer, opacity(work));
    });
  }
  if (plan.runs("unmultiply")) {
    line.composite.emplace_back(line.report("unmultiply"), [&](Work& work) {
      work.frame = straight_alpha_frame(work.frame, work.layer, opacity(work), pool);
    });
  }
  line.encode.emplace_back(line.report("encode"), [&](Work& work) {
    output.sink->write(work.frame);
    spent.give_back(std::move(work.layer));
  });

  // The frame's way: source -> decoded -> tracked -> (drawn here) -> drawn -> finished -> sink.
  const auto start = std::chrono::steady_clock::now();
  Queue decoded(queue_frames), tracked(queue_frames), drawn(queue_frames), finished(queue_frames);
  Queue& to_draw = line.track.empty() ? decoded : tracked;
  Queue& from_draw = line.composite.empty() ? finished : drawn;
  const std::int64_t total = frames_expected(described, options);
  std::exception_ptr failure;  // of any stage: exceptions travel down the queues and end here
  {
    Threads threads({&decoded, &tracked, &drawn, &finished});
    threads.start([&] { decode(*source, options, stop, decode_report, decoded); });
    if (!line.track.empty()) threads.start([&] { hand_on(decoded, line.track, tracked); });
    if (!line.composite.empty()) threads.start([&] { hand_on(drawn, line.composite, finished); });
    threads.start([&] { failure = take_in(finished, line.encode, result.frames); });
    hand_on(to_draw, line.draw, from_draw, [&, done = std::int64_t{0}]() mutable {
      if (progress) progress(++done, total);
    });
    threads.join();
  }
  if (failure) std::rethrow_exception(failure);
  result.interrupted = stop;

  if (result.frames == 0 && !result.interrupted) {
    throw no_frame_error(described, options, decode_report.times.count());
  }
  if (plan.runs("draw") && result.frames > 0 && result.posed_frames == 0 && !result.interrupted) {
    throw no_pose_error(prepared, described, result.frames);
  }
  for (sink::Sink* each : {output.sink.get(), layers.sink.get()}) {
    if (each == nullptr) continue;
    each->finish();
    if (!each->notice().empty()) result.notices.push_back(each->notice());
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!source->damage().empty()) result.notices.push_back(source->damage());
  for (StageReport& report : line.reports) result.stages.push_back(std::move(report));
  return result;
}

}  // namespace rinkaku::pipeline
