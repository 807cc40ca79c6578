#include "pipeline/pipeline.h"

#include <chrono>
#include <optional>
#include <utility>

#include "pipeline/drawing.h"
#include "pipeline/frame/error.h"
#include "pipeline/line.h"
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

using Group = Line::Group;

// Decodes up to the first frame asked for, so that it isn't timed as that one's; returns how many frames came before.
std::int64_t skip_to(source::Source& source, std::int64_t first_frame, const std::atomic<bool>& stop) {
  std::int64_t skipped = 0;
  while (skipped < first_frame && !stop && source.next()) ++skipped;
  return skipped;
}

// The frames from here on, until there are none, or the end, or `stop` says so.
Line::Decode decoder(source::Source& source, const RenderOptions& options, const std::atomic<bool>& stop) {
  return [&]() -> std::optional<Work> {
    if (stop) return std::nullopt;
    std::optional<Frame> frame = source.next();
    if (!frame || frame->number >= options.end_frame) return std::nullopt;
    return Work{std::move(*frame), std::nullopt, {}};
  };
}

// Tells the watcher that the run begins, and that it ended, whichever way that is.
class Watched {
 public:
  Watched(Watcher* watcher, const source::Source& source, const Line& line) : watcher_(watcher) {
    if (watcher_) watcher_->started(source, line);
  }
  ~Watched() {
    if (watcher_) watcher_->ended();
  }
  Watched(const Watched&) = delete;
  Watched& operator=(const Watched&) = delete;

 private:
  Watcher* watcher_;
};

// What the watcher wants drawn from this frame on; what can't be drawn is told to it, and nothing changes.
void take_change(Watcher& watcher, const Frame& frame, Drawing& drawing) {
  std::optional<SceneChange> changed = watcher.changed(frame);
  if (!changed) return;
  try {
    redraw(drawing, changed->scene, std::move(changed->objects));
  } catch (const Error& error) {
    watcher.refused(error.what());
  }
}

}  // namespace

RenderReport render(const Prepared& prepared, const RenderOptions& options, const std::atomic<bool>& stop,
                    const Progress& progress, Watcher* watcher) {
  const Scene& scene = prepared.scene;
  const Plan& plan = prepared.plan;
  RenderReport result;
  result.output = scene.output.path;

  // Set-up, from the source to the sink: whatever is wrong is found before anything is written.
  std::unique_ptr<source::Source> source = open_source(prepared);
  if (watcher) source = watcher->through(std::move(source));
  source->stop_when(stop);
  const source::Description& described = source->description();
  result.width_px = described.format.width_px;
  result.height_px = described.format.height_px;
  if (!described.notice.empty()) result.notices.push_back(described.notice);

  Line line;
  std::unique_ptr<track::Tracker> tracker;
  if (plan.runs("track")) {
    tracker = make_tracker(prepared, described);
    if (watcher) tracker = watcher->tracked_by(std::move(tracker));
    line.add(Group::Track, "track", [&, last = std::optional<TrackedPose>()](Work& work) mutable {
      if (!work.frame.repeated) last = tracker->track(work.frame);
      work.pose = last;
    });
  }

  std::optional<passes::LensMap> lens;
  if (plan.runs("lens")) lens.emplace(*prepared.camera);
  // On the video's clock, whatever its file's says.
  const auto time_s = [first_s = described.first_time_s()](const Frame& frame) { return frame.time_s() - first_s; };
  std::optional<Drawing> drawing;
  SpentLayers spent;
  if (plan.runs("draw")) {
    const passes::PixelRect picture{0, 0, result.width_px, result.height_px};
    drawing.emplace(make_drawing(scene, lens ? lens->pinhole_rect() : picture, {.tell = options.tell, .stop = &stop}));
    result.notices.insert(result.notices.end(), drawing->notices.begin(), drawing->notices.end());
    line.add(Group::Draw, "draw", [&](Work& work) {
      work.layer = spent.take();
      work.layer.rect = {};
      if (watcher) take_change(*watcher, work.frame, *drawing);
      if (!work.pose || work.pose->opacity <= 0) return;
      ++result.posed_frames;
      drawing->renderer->draw({*prepared.camera, work.pose->camera_from_world, time_s(work.frame)}, work.layer);
    });
  }
  passes::Layer distorted;
  if (lens) {
    line.add(Group::Composite, "lens", [&](Work& work) {
      lens->distort(work.layer, distorted);
      std::swap(work.layer, distorted);
    });
  }
  if (watcher) line.add(Group::Composite, "watch", [&](Work& work) { watcher->drawn(work); });
  FramePool pool;
  passes::Blender blender;
  auto opacity = [](const Work& work) { return work.pose ? work.pose->opacity : 0.0; };
  Output output, layers;
  if (plan.runs("encode")) output = open_output(prepared, options, described);
  if (plan.runs("layers")) {
    layers = open_layers(prepared, options, described);
    line.add(Group::Composite, "layers", [&](Work& work) {
      layers.sink->write(straight_alpha_frame(work.frame, work.layer, opacity(work), pool));
    });
  }
  if (plan.runs("composite")) {
    require_blendable(described);
    line.add(Group::Composite, "composite", [&](Work& work) {
      if (work.layer.rect.empty()) return;
      pool.make_writable(work.frame);
      blender.blend(work.frame, work.layer, opacity(work));
    });
  }
  if (plan.runs("unmultiply")) {
    line.add(Group::Composite, "unmultiply",
             [&](Work& work) { work.frame = straight_alpha_frame(work.frame, work.layer, opacity(work), pool); });
  }
  if (watcher) line.add(Group::Composite, "show", [&](Work& work) { watcher->finished(work); });
  std::unique_ptr<sink::Sink> virtual_camera;
  if (plan.runs("virtual-camera")) {
    virtual_camera = open_virtual_camera(prepared, options, described);
    line.add(Group::Composite, "virtual-camera", [&](Work& work) { virtual_camera->write(work.frame); });
  }
  line.add(Group::Encode, "encode", [&](Work& work) {
    if (output.sink && !work.frame.repeated) output.sink->write(work.frame);
    spent.give_back(std::move(work.layer));
  });

  const auto start = std::chrono::steady_clock::now();
  const std::int64_t total = frames_expected(described, options);
  const std::int64_t skipped = skip_to(*source, options.first_frame, stop);
  const Watched watched(watcher, *source, line);
  const Line::Drawn drawn_one = [&, done = std::int64_t{0}]() mutable {
    if (progress) progress(++done, total);
  };
  result.frames =
      line.run(decoder(*source, options, stop), drawn_one, described.live ? Pace::NewestFrame : Pace::EveryFrame);
  result.interrupted = stop;
  result.dropped = line.dropped();
  if (const std::int64_t dropped = result.dropped.before + result.dropped.drawn; dropped > 0) {
    result.notices.push_back(described.name + ": " + std::to_string(dropped) +
                             " pictures came too fast and were left out");
  }

  if (result.frames == 0 && !result.interrupted) {
    throw no_frame_error(described, options, skipped);
  }
  const bool all_there = !result.interrupted && !described.live;
  if (plan.runs("draw") && result.frames > 0 && result.posed_frames == 0 && all_there) {
    throw no_pose_error(prepared, described, result.frames);
  }
  for (sink::Sink* each : {output.sink.get(), layers.sink.get()}) {
    if (each == nullptr) continue;
    each->finish();
    if (!each->notice().empty()) result.notices.push_back(each->notice());
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!source->damage().empty()) result.notices.push_back(source->damage());
  result.stages = line.reports();
  return result;
}

}  // namespace rinkaku::pipeline
