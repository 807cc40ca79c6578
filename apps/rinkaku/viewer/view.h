#pragma once

#include <memory>
#include <optional>
#include <string>

#include "apps/rinkaku/viewer/scene_file.h"
#include "apps/rinkaku/viewer/viewer.h"
#include "pipeline/pipeline.h"

namespace rinkaku::app {

struct ViewOptions {
  pipeline::RenderOptions run;
  double seconds = 0;  ///< then it ends by itself; 0: never
  bool headless = false;
  bool panel = true;
  std::string session;            ///< the folder to keep it in; empty: it isn't kept
  std::string screenshots = ".";  ///< the folder they go to
};

struct ViewReport {
  std::int64_t shown = 0;
  double seconds = 0;
  pipeline::StageTimes latency;   ///< from the camera's stamp to the screen
  pipeline::StageTimes interval;  ///< from one frame on the screen to the next
  source::Health health;
  pipeline::Line::Dropped dropped;
  std::optional<pipeline::RenderReport> run;  ///< of the last run, if it ended well
};

/// Shows a scene in a window until that is closed, or runs it without one; see `rinkaku play --help`. On the main
/// thread. Throws Error: what is wrong before the first frame ends it, what goes wrong later is shown in the window.
ViewReport view(SceneFile& file, const ViewOptions& options);

}  // namespace rinkaku::app
