#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "pipeline/frame/camera_model.h"
#include "pipeline/scene/scene.h"

namespace rinkaku::pipeline {

/// What a run asks for beside the scene.
struct Request {
  bool layers = false;             ///< every layer is written as well
  bool virtual_camera = false;     ///< another program reads the frames
  bool watched = false;            ///< a window shows the frames; an output is then no must
  std::string no_streams_because;  ///< why the input's other streams can't be copied; empty if they can
};

/// One stage, and why it runs or doesn't.
struct Stage {
  std::string name;
  bool runs = false;
  std::string why;
  std::vector<std::string> inputs;  ///< stages whose results it reads
};

/// Which stages a scene needs: pure data, made before anything is built. Stages are in the order a frame meets them.
struct Plan {
  std::vector<Stage> stages;
  bool runs(std::string_view stage) const;
};

/// What a region's lists are used for in drawing an object.
enum class RegionUse {
  None,   ///< drawn whole
  Faces,  ///< which faces turn to the eye and where the contour runs; what is drawn is the same as without
  Cover,  ///< the surface as well comes from the matte's or the depth's list, as nothing of its inside shows
};
RegionUse region_use(const ObjectScene& object);

/// Walks back from the sink: a stage runs if a running stage reads its result and the scene gives it something to do.
/// `camera` is null if the scene has none. Cheap; reads no file.
Plan make_plan(const Scene& scene, const CameraModel* camera, const Request& request);

/// The plan as Graphviz text.
std::string to_dot(const Plan& plan);

}  // namespace rinkaku::pipeline
