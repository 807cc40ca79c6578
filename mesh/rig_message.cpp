#include "mesh/rig_message.h"

#include <algorithm>
#include <cmath>

namespace rinkaku::mesh {
namespace {

template <typename Value>
void put(MessageWriter& out, const Keys<Value>& keys) {
  out.put_array(keys.times_s);
  out.put_array(keys.values);
}

template <typename Value>
void get(MessageReader& in, Keys<Value>& keys) {
  keys.times_s = in.get_array<float>();
  keys.values = in.get_array<Value>();
}

bool finite(const float* values, std::size_t count) {
  return std::all_of(values, values + count, [](float f) { return std::isfinite(f); });
}

bool sound_times(const std::vector<float>& times_s) {
  return !times_s.empty() && finite(times_s.data(), times_s.size()) && std::is_sorted(times_s.begin(), times_s.end());
}

template <typename Value>
bool sound(const Keys<Value>& keys) {
  if (!sound_times(keys.times_s) || keys.values.size() != keys.times_s.size()) return false;
  return finite(&keys.values[0][0], keys.values.size() * static_cast<std::size_t>(Value::length()));
}

bool sound_points(const Rig& rig, std::uint32_t point_count) {
  if (rig.bind_points.size() != point_count || rig.first_influence.size() != point_count + std::size_t{1}) return false;
  if (!finite(&rig.bind_points[0].x, 3 * rig.bind_points.size())) return false;
  if (rig.first_influence.front() != 0 || rig.first_influence.back() != rig.influences.size()) return false;
  for (std::size_t p = 0; p < point_count; ++p) {
    if (rig.first_influence[p] >= rig.first_influence[p + 1]) return false;
  }
  return std::all_of(rig.influences.begin(), rig.influences.end(), [&](const Influence& each) {
    return each.joint < rig.joints.size() && each.weight > 0 && each.weight <= 1.01f;
  });
}

bool sound_skeleton(const Rig& rig) {
  for (std::size_t n = 0; n < rig.nodes.size(); ++n) {
    const RigNode& node = rig.nodes[n];
    if (node.parent != RigNode::kNoParent && node.parent >= n) return false;
    if (!finite(&node.parent_from_node[0][0], 16)) return false;
  }
  return std::all_of(rig.joints.begin(), rig.joints.end(), [&](const Joint& joint) {
    return joint.node < rig.nodes.size() && finite(&joint.node_from_bind[0][0], 16);
  });
}

bool sound(const Morph& morph, std::uint32_t point_count) {
  if (!std::isfinite(morph.rest_weight) || morph.points.size() != morph.offsets.size()) return false;
  const bool known = std::all_of(morph.points.begin(), morph.points.end(), [=](auto p) { return p < point_count; });
  return known && (morph.offsets.empty() || finite(&morph.offsets[0].x, 3 * morph.offsets.size()));
}

bool sound(const Animation& animation, const Rig& rig) {
  if (!(std::isfinite(animation.duration_s) && animation.duration_s >= 0)) return false;
  for (const NodeTrack& track : animation.tracks) {
    if (track.node >= rig.nodes.size()) return false;
    if (!sound(track.position) || !sound(track.rotation) || !sound(track.scale)) return false;
  }
  return std::all_of(animation.morph_tracks.begin(), animation.morph_tracks.end(), [&](const MorphTrack& track) {
    return track.count > 0 && std::uint64_t{track.first_morph} + track.count <= rig.morphs.size() &&
           sound_times(track.times_s) && track.weights.size() == track.times_s.size() * track.count &&
           finite(track.weights.data(), track.weights.size());
  });
}

}  // namespace

void put_rig(MessageWriter& out, const Rig& rig) {
  out.put(static_cast<std::uint64_t>(rig.nodes.size()));
  for (const RigNode& node : rig.nodes) {
    out.put(node.name);
    out.put(node.parent);
    out.put(node.parent_from_node);
  }
  out.put_array(rig.joints);
  out.put_array(rig.bind_points);
  out.put_array(rig.first_influence);
  out.put_array(rig.influences);
  out.put(static_cast<std::uint64_t>(rig.morphs.size()));
  for (const Morph& morph : rig.morphs) {
    out.put(morph.name);
    out.put(morph.rest_weight);
    out.put_array(morph.points);
    out.put_array(morph.offsets);
  }
  out.put(static_cast<std::uint64_t>(rig.animations.size()));
  for (const Animation& animation : rig.animations) {
    out.put(animation.name);
    out.put(animation.duration_s);
    out.put(static_cast<std::uint64_t>(animation.tracks.size()));
    for (const NodeTrack& track : animation.tracks) {
      out.put(track.node);
      put(out, track.position);
      put(out, track.rotation);
      put(out, track.scale);
    }
    out.put(static_cast<std::uint64_t>(animation.morph_tracks.size()));
    for (const MorphTrack& track : animation.morph_tracks) {
      out.put(track.first_morph);
      out.put(track.count);
      out.put_array(track.times_s);
      out.put_array(track.weights);
    }
  }
}

Rig get_rig(MessageReader& in) {
  Rig rig;
  rig.nodes.resize(in.length(sizeof(glm::mat4)));
  for (RigNode& node : rig.nodes) {
    node.name = in.get_text();
    node.parent = in.get<std::uint32_t>();
    node.parent_from_node = in.get<glm::mat4>();
  }
  rig.joints = in.get_array<Joint>();
  rig.bind_points = in.get_array<glm::vec3>();
  rig.first_influence = in.get_array<std::uint32_t>();
  rig.influences = in.get_array<Influence>();
  rig.morphs.resize(in.length(sizeof(std::uint64_t)));
  for (Morph& morph : rig.morphs) {
    morph.name = in.get_text();
    morph.rest_weight = in.get<float>();
    morph.points = in.get_array<std::uint32_t>();
    morph.offsets = in.get_array<glm::vec3>();
  }
  rig.animations.resize(in.length(sizeof(std::uint64_t)));
  for (Animation& animation : rig.animations) {
    animation.name = in.get_text();
    animation.duration_s = in.get<double>();
    animation.tracks.resize(in.length(sizeof(std::uint64_t)));
    for (NodeTrack& track : animation.tracks) {
      track.node = in.get<std::uint32_t>();
      get(in, track.position);
      get(in, track.rotation);
      get(in, track.scale);
    }
    animation.morph_tracks.resize(in.length(sizeof(std::uint64_t)));
    for (MorphTrack& track : animation.morph_tracks) {
      track.first_morph = in.get<std::uint32_t>();
      track.count = in.get<std::uint32_t>();
      track.times_s = in.get_array<float>();
      track.weights = in.get_array<float>();
    }
  }
  return rig;
}

bool sound(const Rig& rig, std::uint32_t point_count) {
  if (rig.empty()) return rig.influences.empty() && rig.animations.empty() && rig.morphs.empty();
  return sound_points(rig, point_count) && sound_skeleton(rig) &&
         std::all_of(rig.morphs.begin(), rig.morphs.end(), [=](const Morph& m) { return sound(m, point_count); }) &&
         std::all_of(rig.animations.begin(), rig.animations.end(), [&](const Animation& a) { return sound(a, rig); });
}

}  // namespace rinkaku::mesh
