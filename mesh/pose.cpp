#include "mesh/pose.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace rinkaku::mesh {
namespace {

/// Between which keys a time lies, and how far on the way.
struct Between {
  std::size_t before, after;
  float part;
};

Between find(const std::vector<float>& times_s, double time_s) {
  const auto next = std::upper_bound(times_s.begin(), times_s.end(), time_s,
                                     [](double time, float key) { return time < static_cast<double>(key); });
  if (next == times_s.begin()) return {0, 0, 0};
  const auto after = static_cast<std::size_t>(next - times_s.begin());
  if (next == times_s.end()) return {after - 1, after - 1, 0};
  const double from_s = times_s[after - 1], to_s = times_s[after];
  return {after - 1, after, static_cast<float>((time_s - from_s) / (to_s - from_s))};
}

glm::vec3 value_at(const Keys<glm::vec3>& keys, double time_s) {
  const Between at = find(keys.times_s, time_s);
  return glm::mix(keys.values[at.before], keys.values[at.after], at.part);
}

glm::quat value_at(const Keys<glm::quat>& keys, double time_s) {
  const Between at = find(keys.times_s, time_s);
  return glm::normalize(glm::slerp(keys.values[at.before], keys.values[at.after], at.part));
}

glm::dmat4 transform(const NodeTrack& track, double time_s) {
  const glm::dvec3 position(value_at(track.position, time_s)), scale(value_at(track.scale, time_s));
  glm::dmat4 m = glm::mat4_cast(glm::dquat(value_at(track.rotation, time_s)));
  for (int axis = 0; axis < 3; ++axis) m[axis] *= scale[axis];
  m[3] = glm::dvec4(position, 1);
  return m;
}

}  // namespace

double animation_time_s(const Playback& playback, double duration_s, double video_time_s) {
  double time_s = (video_time_s - playback.start_s) * playback.speed;
  if (!(duration_s > 0)) return 0;
  if (playback.loop) {
    time_s = std::fmod(time_s, duration_s);
    return time_s < 0 ? time_s + duration_s : time_s;
  }
  if (playback.speed < 0) time_s += duration_s;
  return std::clamp(time_s, 0.0, duration_s);
}

Poser::Poser(const Rig& rig) : rig_(rig), parent_from_node_(rig.nodes.size()), object_from_node_(rig.nodes.size()) {
  pose_.joints.resize(rig.joints.size());
  pose_.morph_weights.resize(rig.morphs.size());
}

const Pose& Poser::rest() {
  static const Animation still;
  return at(still, 0);
}

const Pose& Poser::at(const Animation& animation, double time_s) {
  for (std::size_t n = 0; n < parent_from_node_.size(); ++n) {
    parent_from_node_[n] = glm::dmat4(rig_.nodes[n].parent_from_node);
  }
  for (const NodeTrack& track : animation.tracks) parent_from_node_[track.node] = transform(track, time_s);
  for (std::size_t m = 0; m < pose_.morph_weights.size(); ++m) pose_.morph_weights[m] = rig_.morphs[m].rest_weight;
  for (const MorphTrack& track : animation.morph_tracks) {
    const Between at = find(track.times_s, time_s);
    for (std::uint32_t m = 0; m < track.count; ++m) {
      pose_.morph_weights[track.first_morph + m] =
          glm::mix(track.weights[at.before * track.count + m], track.weights[at.after * track.count + m], at.part);
    }
  }
  compose();
  return pose_;
}

void Poser::compose() {
  for (std::size_t n = 0; n < parent_from_node_.size(); ++n) {
    const std::uint32_t parent = rig_.nodes[n].parent;
    object_from_node_[n] =
        parent == RigNode::kNoParent ? parent_from_node_[n] : object_from_node_[parent] * parent_from_node_[n];
  }
  for (std::size_t j = 0; j < pose_.joints.size(); ++j) {
    const Joint& joint = rig_.joints[j];
    pose_.joints[j] = glm::mat4(object_from_node_[joint.node] * glm::dmat4(joint.node_from_bind));
  }
}

}  // namespace rinkaku::mesh
