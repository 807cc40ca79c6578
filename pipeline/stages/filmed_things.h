#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "pipeline/frame/camera_model.h"
#include "pipeline/line.h"
#include "pipeline/matte/foot_point.h"
#include "pipeline/matte/foreground.h"
#include "pipeline/pipeline.h"
#include "pipeline/source/source.h"

namespace rinkaku::pipeline {

/// The scene's [[foreground]]s: each frame their mattes, how far away they are, and their order of depth.
class FilmedThings {
 public:
  /// Opens what the methods read. `described` is the plate. Throws Error (Input).
  FilmedThings(const Prepared& prepared, const source::Description& described);
  ~FilmedThings();

  /// Fills in work.mattes, nearest first; those that cover nothing come last. The pose must be known by now.
  void find(Work& work);

 private:
  struct Thing;
  std::vector<std::unique_ptr<Thing>> things_;
  std::optional<CameraModel> camera_;
};

/// Where a matte cuts the depth: its distance, infinitely far if it covers nothing.
double cut_m(const Matte& matte);

}  // namespace rinkaku::pipeline
