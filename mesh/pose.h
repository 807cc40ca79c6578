#pragma once

#include <cstdint>
#include <vector>

#include <glm/mat4x4.hpp>

#include "mesh/rig.h"

namespace rinkaku::mesh {

/// Where a rig's joints stand at one moment.
struct Pose {
  std::vector<glm::mat4> joints;     ///< object_from_bind of each joint
  std::vector<float> morph_weights;  ///< of each morph
};

/// How an animation runs with the clock of a video.
struct Playback {
  std::uint32_t animation = 0;
  bool loop = true;    ///< else it stays in its first pose before it starts, and in its last after it ended
  double start_s = 0;  ///< on the video's clock: when the animation is at its beginning
  double speed = 1;    ///< negative: backwards, from the end
};

/// Where the animation is at a time of the video: from 0 to its duration.
double animation_time_s(const Playback& playback, double duration_s, double video_time_s);

/// Poses a rig, again and again. Keeps its memory, so that nothing is allocated once warm.
class Poser {
 public:
  /// The rig must outlive it.
  explicit Poser(const Rig& rig);

  const Pose& rest();
  /// `time_s`: of the animation. Cost: about a microsecond a node.
  const Pose& at(const Animation& animation, double time_s);

 private:
  void compose();

  const Rig& rig_;
  std::vector<glm::dmat4> parent_from_node_, object_from_node_;
  Pose pose_;
};

}  // namespace rinkaku::mesh
