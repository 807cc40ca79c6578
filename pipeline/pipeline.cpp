#include "pipeline/pipeline.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "pipeline/frame/error.h"
#include "pipeline/line.h"
#include "pipeline/objects/drawing.h"
#include "pipeline/passes/composite/blend.h"
#include "pipeline/passes/composite/lens_map.h"
#include "pipeline/passes/composite/merge.h"
#include "pipeline/passes/composite/straight_alpha.h"
#include "pipeline/passes/layer_renderer.h"
#include "pipeline/set_up.h"
#include "pipeline/sink/sink.h"
#include "pipeline/source/source.h"
#include "pipeline/stages/filmed_things.h"
#include "pipeline/stages/layer_files.h"
#include "pipeline/stages/water_stage.h"
#include "pipeline/stages/world.h"
#include "pipeline/track/ahead.h"
#include "pipeline/track/tracker.h"

namespace rinkaku::pipeline {
namespace {

using Group = Line::Group;

// Decodes up to the first frame wanted, so that it isn't timed as that one's; returns how many frames came before.
std::int64_t skip_to(source::Source& source, std::int64_t first_frame, const std::atomic<bool>& stop) {
  std::int64_t skipped = 0;
  while (skipped < first_frame && !stop && source.next()) ++skipped;
  return skipped;
}

// The frames from here on, until there are none, or the end, or `stop` says so; `before` counts those that come before
// the first one asked for.
Line::Decode decoder(source::Source& source, const RenderOptions& options, const std::atomic<bool>& stop,
                     Spent<Work>& spent, std::int64_t& before) {
  return [&]() -> std::optional<Work> {
    if (stop) return std::nullopt;
    std::optional<Frame> frame = source.next();
    if (!frame || frame->number >= options.end_frame) return std::nullopt;
    Work work = spent.take();
    work.run_up = frame->number < options.first_frame;
    if (work.run_up) ++before;
    work.frame = std::move(*frame);
    return work;
  };
}

// The frame's layers to be drawn into, empty.
std::span<passes::Layer> empty_layers(Work& work) {
  work.slices.resize(work.mattes.empty() ? 0 : work.mattes.size() + 1);
  for (passes::Layer& layer : work.slices) layer.rect = {};
  work.layer.rect = {};
  return work.drawn();
}

void empty_parts(Work& work) {
  work.parts.resize(work.drawn().size());
  for (passes::LayerParts& parts : work.parts) parts.lines.rect = parts.depth.rect = {};
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

// One run of the line: what its stages need lives here, in the order in which a frame meets it.
class Run {
 public:
  /// Sets everything up, from the source to the sink: whatever is wrong is found before anything is written.
  Run(const Prepared& prepared, const RenderOptions& options, const std::atomic<bool>& stop, Watcher* watcher);
  RenderReport go(const Progress& progress);

 private:
  void open_source();
  void add_tracking();
  void add_mattes();
  void add_drawing();
  void add_lens();
  void add_layer_files();
  void add_merging();
  void add_compositing();
  void add_outputs();

  void make_water(const Scene& scene);
  void take_change(const Frame& frame);
  void draw(Work& work);
  void merge(Work& work);
  void finish();
  void require_frames(std::int64_t before) const;

  bool runs(std::string_view stage) const { return prepared_.plan.runs(stage); }
  const source::Description& described() const { return source_->description(); }
  // On the video's clock, whatever its file's says.
  double time_s(const Frame& frame) const { return frame.time_s() - described().first_time_s(); }
  static double cg_opacity(const Work& work) { return work.pose ? work.pose->opacity : 0.0; }
  // A world in the plate's place and lines around what was filmed don't fade with the CG.
  double opacity(const Work& work) const { return fades_early() ? 1.0 : cg_opacity(work); }
  bool fades_early() const { return world_ || lines_around_things_; }
  void notice(std::vector<std::string> lines) {
    std::move(lines.begin(), lines.end(), std::back_inserter(report_.notices));
  }

  const Prepared& prepared_;
  const RenderOptions& options_;
  const std::atomic<bool>& stop_;
  Watcher* const watcher_;
  RenderReport report_;
  Line line_;
  Spent<Work> spent_;

  std::unique_ptr<source::Source> source_;
  std::unique_ptr<track::Tracker> tracker_;
  std::optional<TrackedPose> last_pose_;
  std::optional<FilmedThings> filmed_;
  std::optional<passes::LensMap> lens_;
  std::optional<Drawing> drawing_;
  std::optional<WaterStage> water_;
  std::optional<WaterScene> painted_;  // what that was made of
  std::vector<double> cuts_m_;
  passes::Layer scratch_;  // of the compositing thread
  passes::DepthLayer depth_scratch_;
  std::optional<LayerFiles> layers_;
  std::optional<World> world_;
  bool lines_around_things_ = false;
  FramePool pool_;
  passes::Blender blender_;
  Output output_;
  std::unique_ptr<sink::Sink> virtual_camera_;
};

Run::Run(const Prepared& prepared, const RenderOptions& options, const std::atomic<bool>& stop, Watcher* watcher)
    : prepared_(prepared), options_(options), stop_(stop), watcher_(watcher) {
  report_.output = prepared.scene.output.path;
  open_source();
  add_tracking();
  add_mattes();
  add_drawing();
  add_lens();
  if (watcher_) line_.add(Group::Composite, "watch", [this](Work& work) { watcher_->drawn(work); });
  if (runs("encode")) output_ = open_output(prepared_, options_, described());
  add_layer_files();
  add_merging();
  add_compositing();
  add_outputs();
}

void Run::open_source() {
  source_ = pipeline::open_source(prepared_);
  if (watcher_) source_ = watcher_->through(std::move(source_));
  source_->stop_when(stop_);
  report_.width_px = described().format.width_px;
  report_.height_px = described().format.height_px;
  if (!described().notice.empty()) notice({described().notice});
}

void Run::add_tracking() {
  if (!runs("track")) return;
  tracker_ = make_tracker(prepared_, described());
  if (options_.predict_poses) tracker_ = track::make_ahead(std::move(tracker_));
  if (watcher_) tracker_ = watcher_->tracked_by(std::move(tracker_));
  line_.add(Group::Track, "track", [this](Work& work) {
    if (!work.frame.repeated) last_pose_ = tracker_->track(work.frame);
    work.pose = last_pose_;
  });
}

void Run::add_mattes() {
  if (!runs("matte")) return;
  filmed_.emplace(prepared_, described());
  line_.add(Group::Matte, "matte", [this](Work& work) {
    if (!work.run_up) filmed_->find(work);
  });
}

void Run::add_drawing() {
  if (runs("lens")) lens_.emplace(*prepared_.camera);
  if (!runs("draw")) return;
  const passes::PixelRect picture{0, 0, report_.width_px, report_.height_px};
  drawing_.emplace(make_drawing(prepared_.scene, lens_ ? lens_->pinhole_rect() : picture,
                                {.tell = options_.tell, .stop = &stop_, .wait_for_lists = !described().live}));
  notice(drawing_->notices);
  if (runs("water")) {
    make_water(prepared_.scene);
    notice(water_->notices());
    line_.add(Group::Draw, "water", [this](Work& work) {
      take_change(work.frame);
      if (!work.pose || work.pose->opacity <= 0) return;
      water_->look(work.frame, work.pose->camera_from_world, time_s(work.frame));
    });
  }
  line_.add(Group::Draw, "draw", [this](Work& work) {
    if (work.run_up) return;
    if (!water_) take_change(work.frame);
    draw(work);
  });
}

// In place of the water there was; that stays if it throws.
void Run::make_water(const Scene& scene) {
  auto before = drawing_->renderer->hand_out_scene_passes();
  try {
    WaterStage water(scene, *prepared_.camera, frames_per_s(described()), *drawing_);
    water_.emplace(std::move(water));
  } catch (...) {
    for (auto& pass : before) drawing_->renderer->add(std::move(pass));
    throw;
  }
  painted_ = scene.water;
}

// What the watcher wants drawn from this frame on; what can't be drawn is told to it, and stays as it was: objects and
// water each.
void Run::take_change(const Frame& frame) {
  if (!watcher_) return;
  std::optional<SceneChange> changed = watcher_->changed(frame);
  if (!changed) return;
  try {
    redraw(*drawing_, changed->scene, std::move(changed->objects));
    if (water_ && !paints_the_same(*changed->scene.water, *painted_)) make_water(changed->scene);
  } catch (const Error& error) {
    watcher_->refused(error.what());
  }
}

void Run::draw(Work& work) {
  const std::span<passes::Layer> layers = empty_layers(work);
  if (runs("layers")) empty_parts(work);
  if (!work.pose || work.pose->opacity <= 0) return;
  ++report_.posed_frames;
  cuts_m_.clear();
  for (const Matte& matte : work.mattes) cuts_m_.push_back(cut_m(matte));
  drawing_->renderer->draw({*prepared_.camera, work.pose->camera_from_world, time_s(work.frame)}, cuts_m_, layers,
                           work.parts);
}

void Run::add_lens() {
  if (!lens_) return;
  line_.add(Group::Composite, "lens", [this](Work& work) {
    for (passes::Layer& layer : work.drawn()) {
      lens_->distort(layer, scratch_);
      std::swap(layer, scratch_);
    }
    for (passes::LayerParts& parts : work.parts) {
      lens_->distort(parts.lines, scratch_);
      std::swap(parts.lines, scratch_);
      lens_->distort(parts.depth, depth_scratch_);
      std::swap(parts.depth, depth_scratch_);
    }
  });
}

void Run::add_layer_files() {
  if (!runs("layers")) return;
  layers_.emplace(prepared_, options_, described());
  line_.add(Group::Composite, "layers", [this](Work& work) {
    if (!drawing_) empty_layers(work);
    layers_->write(work, cg_opacity(work));
  });
}

void Run::add_merging() {
  if (!runs("merge")) return;
  if (runs("background")) world_.emplace(*prepared_.scene.background, described());
  for (const ForegroundScene& each : prepared_.scene.foregrounds) {
    lines_around_things_ = lines_around_things_ || each.options.line.has_value();
  }
  line_.add(Group::Composite, "merge", [this](Work& work) { merge(work); });
}

void Run::merge(Work& work) {
  if (!drawing_) empty_layers(work);
  if (fades_early()) {
    for (passes::Layer& layer : work.slices) passes::fade(layer, cg_opacity(work));
  }
  if (world_) passes::put_behind(world_->at(time_s(work.frame), work.frame.number), work.slices.back(), scratch_);
  passes::merge({work.slices, work.mattes, runs("composite")}, work.layer);
}

void Run::add_compositing() {
  if (runs("composite")) {
    require_blendable(described());
    line_.add(Group::Composite, "composite", [this](Work& work) {
      if (work.layer.rect.empty()) return;
      pool_.make_writable(work.frame);
      blender_.blend(work.frame, work.layer, opacity(work));
    });
  }
  if (runs("unmultiply")) {
    line_.add(Group::Composite, "unmultiply",
              [this](Work& work) { work.frame = straight_alpha_frame(work.frame, work.layer, opacity(work), pool_); });
  }
}

void Run::add_outputs() {
  if (watcher_) line_.add(Group::Composite, "show", [this](Work& work) { watcher_->finished(work); });
  if (runs("virtual-camera")) {
    virtual_camera_ = open_virtual_camera(prepared_, options_, described());
    line_.add(Group::Composite, "virtual-camera", [this](Work& work) { virtual_camera_->write(work.frame); });
  }
  line_.add(Group::Encode, "encode", [this](Work& work) {
    if (output_.sink && !work.frame.repeated) output_.sink->write(work.frame);
    work.frame = {};
    work.pose.reset();
    spent_.give_back(std::move(work));
  });
}

RenderReport Run::go(const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  const std::int64_t total = frames_expected(described(), options_);
  // Water is shown what it mirrored before.
  const std::int64_t first = water_ ? water_->first_remembered(options_.first_frame) : options_.first_frame;
  std::int64_t before = skip_to(*source_, first, stop_);
  const Watched watched(watcher_, *source_, line_);
  const Line::Drawn drawn_one = [&, done = std::int64_t{0}]() mutable {
    if (progress) progress(++done, total);
  };
  report_.frames = line_.run(decoder(*source_, options_, stop_, spent_, before), drawn_one,
                             described().live ? Pace::NewestFrame : Pace::EveryFrame);
  report_.interrupted = stop_;
  require_frames(before);
  finish();
  report_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  report_.stages = line_.reports();
  return std::move(report_);
}

void Run::require_frames(std::int64_t before) const {
  if (report_.interrupted) return;
  if (report_.frames == 0) throw no_frame_error(described(), options_, before);
  if (runs("draw") && report_.posed_frames == 0 && !described().live) {
    throw no_pose_error(prepared_, described(), report_.frames);
  }
}

// What was written is put in place, and what there is to tell is told.
void Run::finish() {
  report_.dropped = line_.dropped();
  if (const std::int64_t dropped = report_.dropped.before + report_.dropped.drawn; dropped > 0) {
    notice({described().name + ": " + std::to_string(dropped) + " pictures came too fast and were left out"});
  }
  for (sink::Sink* each : {output_.sink.get(), virtual_camera_.get()}) {
    if (each == nullptr) continue;
    each->finish();
    if (!each->notice().empty()) notice({each->notice()});
  }
  if (layers_) notice(layers_->finish());
  if (!source_->damage().empty()) notice({source_->damage()});
}

}  // namespace

RenderReport render(const Prepared& prepared, const RenderOptions& options, const std::atomic<bool>& stop,
                    const Progress& progress, Watcher* watcher) {
  return Run(prepared, options, stop, watcher).go(progress);
}

}  // namespace rinkaku::pipeline
