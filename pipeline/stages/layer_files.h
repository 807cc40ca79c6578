#pragma once

#include <string>
#include <vector>

#include "pipeline/frame/frame.h"
#include "pipeline/line.h"
#include "pipeline/set_up.h"

namespace rinkaku::pipeline {

/// What --layers writes of a scene, in the order of writing: names without frame number and ending.
std::vector<std::string> layer_names(const Scene& scene);

/// PNGs of every layer of each frame, in one folder: the plate, each matte, and each layer of CG with straight alpha.
class LayerFiles {
 public:
  /// Throws Error (Input) if one of the files can't be written.
  LayerFiles(const Prepared& prepared, const RenderOptions& options, const source::Description& described);
  ~LayerFiles();
  LayerFiles(const LayerFiles&) = delete;
  LayerFiles& operator=(const LayerFiles&) = delete;

  /// Before the layers are laid over the plate.
  void write(const Work& work, double opacity);
  /// To be called once, at the end; returns what the sinks had to say.
  std::vector<std::string> finish();

 private:
  void write_matte(const Frame& plate, const Matte& matte);

  std::vector<std::string> names_;
  std::vector<Output> files_;  // in the order of layer_names()
  std::size_t things_;
  FramePool pool_;
};

}  // namespace rinkaku::pipeline
