#pragma once

#include <cstdint>
#include <memory>

#include "pipeline/frame/error.h"
#include "pipeline/frame/frame.h"
#include "pipeline/made_folder.h"
#include "pipeline/passes/layer.h"
#include "pipeline/pipeline.h"
#include "pipeline/sink/sink.h"
#include "pipeline/source/source.h"
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

/// PNGs of the CG alone in the layers folder: cg_000000.png, ...
Output open_layers(const Prepared& prepared, const RenderOptions& options, const source::Description& described);

/// Refuses the filmed camera itself.
std::unique_ptr<sink::Sink> open_virtual_camera(const Prepared& prepared, const RenderOptions& options,
                                                const source::Description& described);

/// How many frames the run will have; 0 if the source doesn't tell.
std::int64_t frames_expected(const source::Description& described, const RenderOptions& options);

/// Throws if CG can't be laid over such pictures.
void require_blendable(const source::Description& described);

/// What to tell when the video ends before the first frame asked for.
Error no_frame_error(const source::Description& described, const RenderOptions& options, std::int64_t decoded);

/// What to tell when no frame had a pose.
Error no_pose_error(const Prepared& prepared, const source::Description& described, std::int64_t frames);

/// A frame with the number and times of `plate` that shows the layer on nothing, with straight alpha.
Frame straight_alpha_frame(const Frame& plate, const passes::Layer& layer, double opacity, FramePool& pool);

}  // namespace rinkaku::pipeline
