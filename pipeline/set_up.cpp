#include "pipeline/set_up.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include <sys/stat.h>

#include "pipeline/passes/composite/blend.h"
#include "pipeline/passes/composite/straight_alpha.h"
#include "pipeline/sink/output_names.h"
#include "pipeline/sink/virtual_camera.h"
#include "pipeline/source/v4l2/camera.h"
#include "pipeline/stages/layer_files.h"
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
std::string no_streams_because(const std::string& input, const std::string& output, bool live) {
  if (output == "-") return "standard output takes the pictures only";
  if (output.find('%') != std::string::npos) return "the output is a sequence of images";
  if (live) return "a camera has no other streams";
  if (!is_file(input) && input.find_first_of("%*?[") != std::string::npos) return "the input is a sequence of images";
  return {};
}

// What was filmed would be written over.
void refuse_own_input(const std::string& output, const std::string& input) {
  using FileId = std::pair<dev_t, ino_t>;
  const auto id_of = [](const std::string& path) -> std::optional<FileId> {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) return std::nullopt;
    return FileId{status.st_dev, status.st_ino};
  };
  std::set<std::optional<FileId>> input_ids;
  for (const std::string& path : source::input_files(input)) input_ids.insert(id_of(path));
  for (const std::string& path : sink::existing_files(output)) {
    if (input_ids.contains(id_of(path))) throw input_error(path, "is the input itself", "choose another output");
  }
}

std::string layer_pattern(const RenderOptions& options, const std::string& name) {
  return (fs::path(options.layers_folder) / (name + "_%06d.png")).string();
}

Output open_in_folder(const sink::Options& to, const sink::Incoming& in) {
  Output output;
  const fs::path folder = fs::path(to.path).parent_path();
  if (sink::is_sequence(to.path) && !folder.empty()) output.folder = std::make_unique<MadeFolder>(folder);
  output.sink = sink::open(to, in);
  return output;
}

// Players turn the video, programs that calibrate may do so too, and rinkaku doesn't.
void refuse_turned_camera(const Prepared& prepared, const source::Description& described) {
  const CameraModel& camera = *prepared.camera;
  const PictureFormat& format = described.format;
  const bool swapped = camera.width_px == format.height_px && camera.height_px == format.width_px;
  if (!swapped || described.rotation_deg % 180 == 0) return;
  const auto size = [](int width, int height) { return std::to_string(width) + "x" + std::to_string(height); };
  throw input_error(prepared.scene.plate.camera.string(),
                    "the camera was calibrated at " + size(camera.width_px, camera.height_px) + ", but " +
                        described.name + " is stored as " + size(format.width_px, format.height_px) +
                        ": players turn it by " + std::to_string(described.rotation_deg) +
                        " degrees anticlockwise, rinkaku works on the stored picture",
                    "calibrate with 'rinkaku calibrate' from a video filmed the same way, it doesn't turn either");
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

// Where the scene leaves the size open, it is the one that the camera was calibrated at.
source::v4l2::CameraOptions camera_options(const Prepared& prepared) {
  const CameraDevice& scene = *prepared.scene.plate.device;
  source::v4l2::CameraOptions options;
  options.device = scene.device;
  options.wish.width_px = scene.width_px;
  options.wish.height_px = scene.height_px;
  if (scene.width_px == 0 && prepared.camera) {
    options.wish.width_px = prepared.camera->width_px;
    options.wish.height_px = prepared.camera->height_px;
  }
  if (scene.fps) options.wish.rate = *scene.fps;
  if (!scene.format.empty()) {
    options.wish.format = source::v4l2::format_named(scene.format);
    if (options.wish.format == 0) {
      throw input_error(prepared.scene.file.string(), "the camera's format '" + scene.format + "' is none that is read",
                        "give YUYV, UYVY, NV12, YU12, GREY or MJPG");
    }
  }
  for (const CameraDevice::Control& control : scene.controls) {
    options.controls.push_back({control.name, control.value, control.where});
  }
  return options;
}

}  // namespace

PictureFormat straight_alpha_format(const PictureFormat& plate) {
  return passes::rgba_format(plate.width_px, plate.height_px, plate.sample_aspect);
}

Prepared prepare(Scene scene, const RenderOptions& options) {
  // Whoever looks on need not want what the scene writes.
  if (!options.output.empty() || options.watched) scene.output.path = options.output;
  if (!options.codec.empty()) scene.output.codec = options.codec;
  if (options.bit_rate > 0) scene.output.bit_rate = options.bit_rate;
  Prepared prepared;
  if (!scene.plate.camera.empty()) prepared.camera = track::read_camera(scene.plate.camera);
  Request request;
  request.watched = options.watched;
  request.virtual_camera = !options.virtual_camera.empty();
  request.layers = !options.layers_folder.empty();
  request.no_streams_because = no_streams_because(scene.plate.input, scene.output.path, scene.plate.device.has_value());
  prepared.plan = make_plan(scene, prepared.camera ? &*prepared.camera : nullptr, request);
  prepared.scene = std::move(scene);
  return prepared;
}

std::unique_ptr<source::Source> open_source(const Prepared& prepared) {
  const PlateScene& plate = prepared.scene.plate;
  source::OpenOptions options;
  if (plate.fps) options.image_rate = *plate.fps;
  auto source = plate.device ? source::v4l2::open_camera(camera_options(prepared)) : source::open(plate.input, options);
  const PictureFormat& format = source->description().format;
  if (prepared.camera) {
    refuse_turned_camera(prepared, source->description());
    track::check_resolution(*prepared.camera, prepared.scene.plate.camera, format.width_px, format.height_px);
  }
  return source;
}

std::unique_ptr<track::Tracker> make_tracker(const Prepared& prepared, const source::Description& described) {
  const TrackScene& scene = *prepared.scene.track;
  struct Convert {
    track::TrackOptions& to;
    double first_time_s;
    void operator()(const MarkerTrack& m) const { to.from = track::FromMarker{m.dictionary, m.id, m.size_m}; }
    void operator()(const BoardTrack& b) const { to.from = track::FromBoard{b.board}; }
    void operator()(const PoseFileTrack& p) const { to.from = track::FromPoseFile{p.poses, first_time_s}; }
    void operator()(const LockedTrack& l) const { to.from = track::LockedCamera{l.position_m, l.look_at_m, l.up}; }
  };
  track::TrackOptions options;
  std::visit(Convert{options, described.first_time_s()}, scene.from);
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

Output open_output(const Prepared& prepared, const RenderOptions& options, const source::Description& described) {
  const OutputScene& output = prepared.scene.output;
  if (output.path.empty()) {
    throw input_error(prepared.scene.file.string(), "names no output", "give -o OUT, or add [output] with 'video'");
  }
  if (!options.container.empty() && output.path != "-") {
    throw input_error("--format", "is for standard output, and the output is " + output.path,
                      "leave it out, or give -o -");
  }
  if (output.path != "-") refuse_own_input(output.path, prepared.scene.plate.input);
  if (prepared.plan.runs("layers")) {
    for (const LayerFile& layer : layer_files(prepared.scene)) {
      if (!sink::share_a_file(output.path, layer_pattern(options, layer.name))) continue;
      throw input_error(output.path, "the layers are to be written under the same names",
                        "choose another output, or another folder for --layers");
    }
  }
  sink::Options to;
  to.path = output.path;
  to.codec = output.codec;
  to.container = options.container;
  to.bit_rate = output.bit_rate;
  to.overwrite = options.overwrite;
  to.recording = options.watched;
  sink::Incoming in = incoming(
      described, prepared.plan.runs("unmultiply") ? straight_alpha_format(described.format) : described.format);
  if (prepared.plan.runs("copy-streams")) in.copy_streams_from = prepared.scene.plate.input;
  return open_in_folder(to, in);
}

Output open_layer(const Prepared& prepared, const RenderOptions& options, const source::Description& described,
                  const std::string& name, const PictureFormat& format) {
  sink::Options to;
  to.path = layer_pattern(options, name);
  refuse_own_input(to.path, prepared.scene.plate.input);
  to.overwrite = options.overwrite;
  return open_in_folder(to, incoming(described, format));
}

std::unique_ptr<sink::Sink> open_virtual_camera(const Prepared& prepared, const RenderOptions& options,
                                                const source::Description& described) {
  if (prepared.scene.plate.device && options.virtual_camera == described.name) {
    throw input_error(options.virtual_camera, "is the camera that is filmed with", "choose another virtual camera");
  }
  return sink::open_virtual_camera(
      options.virtual_camera,
      incoming(described,
               prepared.plan.runs("unmultiply") ? straight_alpha_format(described.format) : described.format));
}

std::int64_t frames_expected(const source::Description& described, const RenderOptions& options) {
  if (described.frame_count <= 0) return 0;
  return std::max<std::int64_t>(0, std::min(described.frame_count, options.end_frame) - options.first_frame);
}

double frames_per_s(const source::Description& described) {
  return described.frame_rate.num > 0 ? described.frame_rate.value() : 25;
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
