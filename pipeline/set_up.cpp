#include "pipeline/set_up.h"

#include <algorithm>
#include <filesystem>

#include "pipeline/passes/composite/blend.h"
#include "pipeline/passes/composite/straight_alpha.h"
#include "pipeline/track/camera_file.h"
#include "pipeline/track/make_tracker.h"

namespace rinkaku::pipeline {
namespace {

namespace fs = std::filesystem;

bool is_file(const std::string& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

// Why the sound can't follow; empty if it can.
std::string no_streams_because(const std::string& input, const std::string& output) {
  if (output == "-") return "standard output takes the pictures only";
  if (output.find('%') != std::string::npos) return "the output is a sequence of images";
  if (!is_file(input) && input.find_first_of("%*?[") != std::string::npos) return "the input is a sequence of images";
  return {};
}

// The input would be written over while it is read.
void refuse_own_input(const std::string& output, const std::string& input) {
  std::error_code error;
  const bool same_file = fs::exists(output, error) && fs::equivalent(output, input, error);
  const bool same_name = fs::weakly_canonical(fs::absolute(output, error), error) ==
                         fs::weakly_canonical(fs::absolute(input, error), error);
  if (same_file || same_name) throw input_error(output, "is the input itself", "choose another output");
}

sink::Incoming incoming(const source::Description& described, const PictureFormat& format) {
  sink::Incoming in;
  in.format = format;
  in.time_base = described.time_base;
  in.frame_rate = described.frame_rate;
  in.variable_frame_rate = described.variable_frame_rate;
  in.rotation_deg = described.rotation_deg;
  return in;
}

PictureFormat straight_alpha_format(const PictureFormat& plate) {
  return passes::rgba_format(plate.width_px, plate.height_px, plate.sample_aspect);
}

}  // namespace

Prepared prepare(Scene scene, const RenderOptions& options) {
  if (!options.output.empty()) scene.output.path = options.output;
  if (!options.codec.empty()) scene.output.codec = options.codec;
  if (options.bit_rate > 0) scene.output.bit_rate = options.bit_rate;
  Prepared prepared;
  if (!scene.plate.camera.empty()) prepared.camera = track::read_camera(scene.plate.camera);
  Request request;
  request.layers = !options.layers_folder.empty();
  request.no_streams_because = no_streams_because(scene.plate.input, scene.output.path);
  prepared.plan = make_plan(scene, prepared.camera ? &*prepared.camera : nullptr, request);
  prepared.scene = std::move(scene);
  return prepared;
}

std::unique_ptr<source::Source> open_source(const Prepared& prepared) {
  auto source = source::open(prepared.scene.plate.input);
  const PictureFormat& format = source->description().format;
  if (prepared.camera) {
    track::check_resolution(*prepared.camera, prepared.scene.plate.camera, format.width_px, format.height_px);
  }
  return source;
}

std::unique_ptr<track::Tracker> make_tracker(const Prepared& prepared) {
  const TrackScene& scene = *prepared.scene.track;
  struct Convert {
    track::TrackOptions& to;
    void operator()(const MarkerTrack& m) const { to.from = track::FromMarker{m.dictionary, m.id, m.size_m}; }
    void operator()(const BoardTrack& b) const { to.from = track::FromBoard{b.board}; }
    void operator()(const PoseFileTrack& p) const { to.from = track::FromPoseFile{p.poses}; }
    void operator()(const LockedTrack& l) const { to.from = track::LockedCamera{l.position_m, l.look_at_m, l.up}; }
  };
  track::TrackOptions options;
  std::visit(Convert{options}, scene.from);
  options.where = prepared.scene.file.string();
  options.hold_s = scene.hold_s;
  options.fade_s = scene.fade_s;
  if (prepared.plan.runs("smooth")) {
    options.smoothing.emplace();
    options.smoothing->min_cutoff_hz = scene.smoothing.min_cutoff_hz;
    options.smoothing->beta = scene.smoothing.beta;
  }
  return track::make_tracker(options, *prepared.camera);
}

std::unique_ptr<sink::Sink> open_sink(const Prepared& prepared, const RenderOptions& options,
                                      const source::Description& described) {
  const OutputScene& output = prepared.scene.output;
  if (output.path.empty()) {
    throw input_error(prepared.scene.file.string(), "names no output", "give -o OUT, or add [output] with 'video'");
  }
  if (!options.container.empty() && output.path != "-") {
    throw input_error("--format", "is for standard output, and the output is " + output.path,
                      "leave it out, or give -o -");
  }
  if (output.path != "-") refuse_own_input(output.path, prepared.scene.plate.input);
  sink::Options to;
  to.path = output.path;
  to.codec = output.codec;
  to.container = options.container;
  to.bit_rate = output.bit_rate;
  to.overwrite = options.overwrite;
  sink::Incoming in = incoming(
      described, prepared.plan.runs("unmultiply") ? straight_alpha_format(described.format) : described.format);
  if (prepared.plan.runs("copy-streams")) in.copy_streams_from = prepared.scene.plate.input;
  return sink::open(to, in);
}

LayerOutput::LayerOutput(const RenderOptions& options, const source::Description& described)
    : folder(options.layers_folder) {
  sink::Options to;
  to.path = (fs::path(options.layers_folder) / "cg_%06d.png").string();
  to.overwrite = options.overwrite;
  sink = sink::open(to, incoming(described, straight_alpha_format(described.format)));
}

std::int64_t frames_expected(const source::Description& described, const RenderOptions& options) {
  if (described.frame_count <= 0) return 0;
  return std::max<std::int64_t>(0, std::min(described.frame_count, options.end_frame) - options.first_frame);
}

void require_blendable(const source::Description& described) {
  if (passes::can_blend(described.format.pixels)) return;
  throw input_error(described.name, "CG can't be laid over pictures of the format " + described.format.pixels.name,
                    "convert the video first, e.g. ffmpeg -i IN -pix_fmt yuv420p OUT");
}

Error no_frame_error(const source::Description& described, const RenderOptions& options, std::int64_t decoded) {
  const std::string held = std::to_string(decoded) + (decoded == 1 ? " frame" : " frames");
  return input_error(described.name, "it has " + held + ", none from " + std::to_string(options.first_frame) + " on",
                     "give --frames A:B with A below " + std::to_string(decoded));
}

Error no_pose_error(const Prepared& prepared, const source::Description& described, std::int64_t frames) {
  const std::string in_frames = frames == 1 ? " in the only frame" : " in any of " + std::to_string(frames) + " frames";
  struct Say {
    const std::string& in_frames;
    std::pair<std::string, std::string> operator()(const MarkerTrack& m) const {
      return {"marker " + std::to_string(m.id) + " of " + m.dictionary + " was not seen" + in_frames,
              "check dictionary and id, and that the marker is sharp and at least 20 pixels wide with a white border"};
    }
    std::pair<std::string, std::string> operator()(const BoardTrack& b) const {
      return {"no marker of " + b.board.filename().string() + " was seen" + in_frames,
              "check the board's dictionary and that its markers are sharp and at least 20 pixels wide"};
    }
    std::pair<std::string, std::string> operator()(const PoseFileTrack& p) const {
      return {p.poses.filename().string() + " has no pose" + in_frames,
              "check that its frame numbers (from 0) or times (from 0 s) are this video's"};
    }
    std::pair<std::string, std::string> operator()(const LockedTrack&) const { return {"no pose" + in_frames, ""}; }
  };
  const auto [what, remedy] = std::visit(Say{in_frames}, prepared.scene.track->from);
  return input_error(described.name, what, remedy);
}

Frame straight_alpha_frame(const Frame& plate, const passes::Layer& layer, double opacity, FramePool& pool) {
  Frame frame = pool.allocate(straight_alpha_format(plate.format));
  frame.number = plate.number;
  frame.pts = plate.pts;
  frame.duration = plate.duration;
  frame.time_base = plate.time_base;
  passes::to_straight_alpha(layer, opacity, frame);
  return frame;
}

}  // namespace rinkaku::pipeline
