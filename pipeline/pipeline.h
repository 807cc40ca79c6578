#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "pipeline/line.h"
#include "pipeline/plan.h"
#include "pipeline/scene/scene.h"
#include "pipeline/watcher.h"

namespace rinkaku::pipeline {

/// What the command line says beside the scene; empty values leave the scene's own.
struct RenderOptions {
  std::string output{};  ///< a video file, a pattern of images, or "-" for standard output
  std::string codec{};
  std::string container{};  ///< "y4m" or "raw" for standard output
  std::int64_t bit_rate = 0;
  std::int64_t first_frame = 0;
  std::int64_t end_frame = std::numeric_limits<std::int64_t>::max();  ///< exclusive
  std::string layers_folder{};                                        ///< empty: layers are not written
  bool overwrite = false;
  bool predict_poses = false;  ///< no frame waits for its own pose (see track::make_ahead); for live use
  std::function<void(const std::string& line)> tell{};  ///< what set-up has to say at once, as it takes long
  std::string virtual_camera{};                         ///< a video output device that gets the frames as well
  bool watched = false;                                 ///< by a window: only `output` is then written, if it is given
};

struct RenderReport {
  std::int64_t frames = 0;
  double seconds = 0;
  int width_px = 0;
  int height_px = 0;
  std::string output;
  std::int64_t posed_frames = 0;  ///< frames whose camera pose was known
  std::vector<StageReport> stages;
  Line::Dropped dropped;             ///< live: frames that came while nobody was free for them
  std::vector<std::string> notices;  ///< damage, conversions, lines to be shown to the user
  bool interrupted = false;
};

/// Called on the calling thread after each frame: frames done, and how many there will be (0: unknown).
using Progress = std::function<void(std::int64_t done, std::int64_t total)>;

/// The scene with the options that replace its values, and the camera it names (null if none), checked against each
/// other.
struct Prepared {
  Scene scene;
  std::optional<CameraModel> camera;
  Plan plan;
};
Prepared prepare(Scene scene, const RenderOptions& options);

/// Renders a scene from its source to its sink, to whoever watches, or both; the main job.
///
/// Decoding, tracking, drawing and encoding run at the same time, each on a thread of its own (drawing on the calling
/// one), joined by bounded queues: memory does not grow with the video. Plate, pose and CG of a frame travel together.
/// A camera's frames are not waited for by anybody: what comes too late is dropped, so that what is shown is new.
/// `stop` set to true ends it as the end of the video would: what was rendered is kept and whole.
/// With a watcher the scene needs no output. Throws Error; nothing is then left under the output's name.
RenderReport render(const Prepared& prepared, const RenderOptions& options, const std::atomic<bool>& stop,
                    const Progress& progress = {}, Watcher* watcher = nullptr);

}  // namespace rinkaku::pipeline
