#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "pipeline/passes/layer.h"
#include "pipeline/scene/background.h"
#include "pipeline/source/source.h"

namespace rinkaku::pipeline {

/// What stands in the plate's place behind filmed things and CG: a colour, a picture or a video.
///
/// Pictures are scaled to cover the plate, what stands over is cut off evenly. A video that is shorter than the plate
/// begins again.
class World {
 public:
  /// Throws Error (Input) if the picture can't be read.
  World(const BackgroundScene& scene, const source::Description& plate);

  /// The next frame's picture: an opaque layer of the plate's size, valid until the next call.
  const passes::Layer& next();

 private:
  bool read();
  void open();

  std::string input_;
  source::OpenOptions options_;
  std::unique_ptr<source::Source> source_;
  passes::Layer picture_;
  std::int64_t shown_ = 0;
  bool moves_ = false;  // it is no single picture
};

}  // namespace rinkaku::pipeline
