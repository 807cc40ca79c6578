#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "pipeline/passes/layer.h"
#include "pipeline/scene/background.h"
#include "pipeline/source/source.h"

namespace rinkaku::pipeline {

/// What stands in the plate's place behind filmed things and CG: a colour, a picture or a video.
///
/// Pictures are scaled to cover the plate, what stands over is cut off evenly. A video plays at its own pace, whatever
/// the plate's is, and begins again when it has ended; of an image sequence each frame of the plate has the next.
class World {
 public:
  /// Throws Error (Input) if the picture can't be read.
  World(const BackgroundScene& scene, const source::Description& plate);

  /// What stands there at this time from the plate's first frame on, or by this frame's number if it is a sequence: an
  /// opaque layer of the plate's size, valid until the next call. Neither may go back.
  const passes::Layer& at(double time_s, std::int64_t frame);

 private:
  void open();
  void read_ahead(double now);
  void show(const Frame& frame);

  std::string input_;
  source::OpenOptions options_;
  std::unique_ptr<source::Source> source_;
  passes::Layer picture_;
  bool is_sequence_ = false;
  std::optional<Frame> ahead_;  // the next to be shown, and when
  double ahead_at_ = 0;
  double began_at_ = 0;  // this time round
  double lasts_ = 0;     // of the frame ahead
  double rate_ = 25;     // frames a second
  bool moves_ = false;   // it is no single picture
  bool plate_is_live_ = false;
};

}  // namespace rinkaku::pipeline
