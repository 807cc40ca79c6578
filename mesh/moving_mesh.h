#pragma once

#include <memory>
#include <optional>

#include "mesh/mesh.h"
#include "mesh/pose.h"
#include "mesh/rig.h"
#include "mesh/skin.h"
#include "mesh/topology.h"

namespace rinkaku::mesh {

/// A mesh that is played with a video: the same time gives the same pose, whatever was shown before.
class MovingMesh {
 public:
  /// Precondition: the rig has the playback's animation. Keeps neither mesh nor topology.
  MovingMesh(const Mesh& mesh, const Topology& topology, Rig rig, const Playback& playback);

  /// Returns whether the mesh has moved since the last call. Allocates nothing.
  bool move_to(double video_time_s);
  /// The same for the points alone; normals are to be asked of the skin.
  bool move_points_to(double video_time_s);

  const Skin& skin() const { return skin_; }
  Skin& skin() { return skin_; }

 private:
  /// Null if it is the last one.
  const Pose* next_pose(double video_time_s);

  std::unique_ptr<const Rig> rig_;  // at one place, as the poser refers to it
  Playback playback_;
  Poser poser_;
  Skin skin_;
  std::optional<double> time_s_;  // of the animation
};

}  // namespace rinkaku::mesh
