#pragma once

#include <string>
#include <vector>

#include "pipeline/frame/frame.h"
#include "pipeline/line.h"
#include "pipeline/set_up.h"

namespace rinkaku::pipeline {

/// One of the files that --layers writes for each frame.
struct LayerFile {
  enum class Holds { Plate, Matte, ThingLine, Cg, Lines, Depth } holds;
  std::size_t of = 0;  ///< which thing, or which slice of depth
  std::string name;    ///< without frame number and ending
};
/// What --layers writes of a scene, in the order of writing.
std::vector<LayerFile> layer_files(const Scene& scene);

/// PNGs of every layer of each frame, in one folder: the plate, each matte and the line around its thing, and of each
/// layer of CG colours and lines with straight alpha, and depth: 16 bits, millimetres along the camera's axis, 0 where
/// nothing was drawn and 65535 for all that is farther than 65.5345 m.
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
  void write_matte(const Frame& plate, const Matte& matte, sink::Sink& to);
  void write_thing_line(const Frame& plate, const Matte& matte, sink::Sink& to);
  void write_depth(const Frame& plate, const passes::DepthLayer& depth, sink::Sink& to);
  Frame frame_like(const Frame& plate, const PictureFormat& format);

  std::vector<LayerFile> layers_;
  std::vector<Output> files_;  // in the order of layers_
  FramePool pool_;
  passes::Layer thing_line_;
};

}  // namespace rinkaku::pipeline
