#include "mesh/moving_mesh.h"

#include <utility>

namespace rinkaku::mesh {

MovingMesh::MovingMesh(const Mesh& mesh, const Topology& topology, Rig rig, const Playback& playback)
    : rig_(std::make_unique<Rig>(std::move(rig))), playback_(playback), poser_(*rig_), skin_(mesh, topology, *rig_) {}

const Pose* MovingMesh::next_pose(double video_time_s) {
  const Animation& animation = rig_->animations[playback_.animation];
  const double time_s = animation_time_s(playback_, animation.duration_s, video_time_s);
  if (time_s_ == time_s) return nullptr;
  time_s_ = time_s;
  return &poser_.at(animation, time_s);
}

bool MovingMesh::move_to(double video_time_s) {
  const Pose* const pose = next_pose(video_time_s);
  if (pose != nullptr) skin_.pose(*pose);
  return pose != nullptr;
}

bool MovingMesh::move_points_to(double video_time_s) {
  const Pose* const pose = next_pose(video_time_s);
  if (pose != nullptr) skin_.pose_points(*pose);
  return pose != nullptr;
}

}  // namespace rinkaku::mesh
