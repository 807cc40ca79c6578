#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace rinkaku::mesh {

/// A joint's share in where a point goes.
struct Influence {
  std::uint32_t joint = 0;
  float weight = 0;  ///< above 0; a point's add up to 1
};

struct RigNode {
  static constexpr std::uint32_t kNoParent = 0xffffffffu;
  std::string name;
  std::uint32_t parent = kNoParent;  ///< a node before this one
  glm::mat4 parent_from_node{1};     ///< at rest
};

/// A node that carries points, and how they are brought into its coordinates (a bone's inverse bind matrix).
struct Joint {
  std::uint32_t node = 0;
  glm::mat4 node_from_bind{1};
};

/// Offsets of some points, to be added times a weight before joints move them (a blend shape).
struct Morph {
  std::string name;
  float rest_weight = 0;
  std::vector<std::uint32_t> points;  ///< each once
  std::vector<glm::vec3> offsets;     ///< in bind coordinates
};

/// Values at times that don't fall; at least one. Between them they are interpolated (rotations on the shorter arc),
/// before the first and after the last they stay.
template <typename Value>
struct Keys {
  std::vector<float> times_s;
  std::vector<Value> values;
};

/// What an animation does to a node: replaces its parent_from_node by translation * rotation * scale.
struct NodeTrack {
  std::uint32_t node = 0;
  Keys<glm::vec3> position;
  Keys<glm::quat> rotation;  ///< unit
  Keys<glm::vec3> scale;
};

/// What it does to the weights of a run of morphs.
struct MorphTrack {
  std::uint32_t first_morph = 0;
  std::uint32_t count = 0;
  std::vector<float> times_s;
  std::vector<float> weights;  ///< `count` for each time
};

struct Animation {
  std::string name;
  double duration_s = 0;
  std::vector<NodeTrack> tracks;
  std::vector<MorphTrack> morph_tracks;
};

/// How a mesh moves: a hierarchy of nodes, which of them carry each point, blend shapes, and animations. A point goes
/// to
///   sum over its influences of weight * object_from_node * node_from_bind * (bind point + sum of morph offsets),
/// for any number of influences. In the rest pose that is where Mesh::positions has it.
///
/// "Point" is a welded point of the mesh (in a Soup: a vertex). Empty for a mesh that doesn't move.
struct Rig {
  std::vector<RigNode> nodes;
  std::vector<Joint> joints;
  std::vector<glm::vec3> bind_points;          ///< per point
  std::vector<std::uint32_t> first_influence;  ///< per point where its run in `influences` starts, and the end
  std::vector<Influence> influences;
  std::vector<Morph> morphs;
  std::vector<Animation> animations;

  bool empty() const { return bind_points.empty(); }
};

}  // namespace rinkaku::mesh
