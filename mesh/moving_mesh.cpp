#include "mesh/moving_mesh.h"

#include <utility>

namespace rinkaku::mesh {

MovingMesh::MovingMesh(const Mesh& mesh, const Topology& topology, Rig rig, const Playback& playback)
    : rig_(std::make_unique<Rig>(std::move(rig))),
      playback_(playback),
      poser_(*rig_),
      pose_(&poser_.rest()),
      skin_(mesh, topology, *rig_) {}

bool MovingMesh::find_pose(double video_time_s) {
  const Animation& animation = rig_->animations[playback_.animation];
  const double time_s = animation_time_s(playback_, animation.duration_s, video_time_s);
  if (time_s_ == time_s) return false;
  time_s_ = time_s;
  pose_ = &poser_.at(animation, time_s);
  return true;
}

bool MovingMesh::move_to(double video_time_s) {
  if (!find_pose(video_time_s)) return false;
  skin_.pose(*pose_);
  return true;
}

bool MovingMesh::move_points_to(double video_time_s) {
  if (!find_pose(video_time_s)) return false;
  skin_.pose_points(*pose_);
  return true;
}

}  // namespace rinkaku::mesh
