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
  std::unique_ptr<track::Tracker> tracker;
  if (plan.runs("track")) {
    tracker = make_tracker(prepared, described);
    line.add(Group::Track, "track", [&](Work& work) { work.pose = tracker->track(work.frame); });
  }

  std::optional<passes::LensMap> lens;
  if (plan.runs("lens")) lens.emplace(*prepared.camera);
  // On the video's clock, whatever its file's says.
  const auto time_s = [first_s = described.first_time_s()](const Frame& frame) { return frame.time_s() - first_s; };
  std::optional<Drawing> drawing;
  SpentLayers spent;
  if (plan.runs("draw")) {
    drawing.emplace(
        make_drawing(scene, lens ? lens->pinhole_rect() : passes::PixelRect{0, 0, result.width_px, result.height_px}));
    result.notices.insert(result.notices.end(), drawing->notices.begin(), drawing->notices.end());
    line.add(Group::Draw, "draw", [&](Work& work) {
      work.layer = spent.take();
      work.layer.rect = {};
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
  FramePool pool;
  passes::Blender blender;
  auto opacity = [](const Work& work) { return work.pose ? work.pose->opacity : 0.0; };
  const Output output = open_output(prepared, options, described);
  Output layers;
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
  line.add(Group::Encode, "encode", [&](Work& work) {
    output.sink->write(work.frame);
    spent.give_back(std::move(work.layer));
  });

  const auto start = std::chrono::steady_clock::now();
  const std::int64_t total = frames_expected(described, options);
  const std::int64_t skipped = skip_to(*source, options.first_frame, stop);
  result.frames = line.run(decoder(*source, options, stop), [&, done = std::int64_t{0}]() mutable {
    if (progress) progress(++done, total);
  });
  result.interrupted = stop;

  if (result.frames == 0 && !result.interrupted) {
    throw no_frame_error(described, options, skipped);
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
  result.stages = line.reports();
  return result;
}

}  // namespace rinkaku::pipeline
