#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "pipeline/frame/error.h"
#include "pipeline/frame/frame.h"
#include "pipeline/passes/layer.h"
#include "pipeline/pipeline.h"
#include "pipeline/sink/sink.h"
#include "pipeline/source/source.h"
#include "pipeline/stages/made_folder.h"
#include "pipeline/track/tracker.h"

namespace rinkaku::pipeline {

/// The parts that render() joins, each made from the scene and the options. All throw Error (Input).

/// The scene's plate; checks that the camera was calibrated for its size.
std::unique_ptr<source::Source> open_source(const Prepared& prepared);

std::unique_ptr<track::Tracker> make_tracker(const Prepared& prepared, const source::Description& described);

/// A sink and the folder that was made for it, if its pictures' folder wasn't there.
struct Output {
  std::unique_ptr<MadeFolder> folder;  // outlives the sink, which may take its files away again
  std::unique_ptr<sink::Sink> sink;
};

/// Refuses to write over the input, or over the layers.
Output open_output(const Prepared& prepared, const RenderOptions& options, const source::Description& described);

/// PNGs of one layer in the layers folder: NAME_000000.png, ... of frames of that format.
Output open_layer(const Prepared& prepared, const RenderOptions& options, const source::Description& described,
                  const std::string& name, const PictureFormat& format);

/// Refuses the filmed camera itself.
std::unique_ptr<sink::Sink> open_virtual_camera(const Prepared& prepared, const RenderOptions& options,
                                                const source::Description& described);

/// How many frames the run will have; 0 if the source doesn't tell.
std::int64_t frames_expected(const source::Description& described, const RenderOptions& options);

/// Of the plate; 25 if its file doesn't tell.
double frames_per_s(const source::Description& described);

/// Throws if CG can't be laid over such pictures.
void require_blendable(const source::Description& described);

/// What to tell when the video ends before the first frame asked for.
Error no_frame_error(const source::Description& described, const RenderOptions& options, std::int64_t decoded);

/// What to tell when no frame had a pose.
Error no_pose_error(const Prepared& prepared, const source::Description& described, std::int64_t frames);

/// The format of the CG alone, on nothing, for such a plate.
PictureFormat straight_alpha_format(const PictureFormat& plate);

/// A frame with the number and times of `plate` that shows the layer on nothing, with straight alpha.
Frame straight_alpha_frame(const Frame& plate, const passes::Layer& layer, double opacity, FramePool& pool);

}  // namespace rinkaku::pipeline
