#include "mesh/import_worker/rig_reader.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include "mesh/import_message.h"
#include "mesh/import_worker/read_file.h"

namespace rinkaku::mesh {
namespace {

glm::mat4 matrix(const aiMatrix4x4& m) { return glm::transpose(glm::make_mat4(&m.a1)); }
glm::vec3 vector(const aiVector3D& v) { return {v.x, v.y, v.z}; }

bool finite(const float* values, int count) {
  return std::all_of(values, values + count, [](float f) { return std::isfinite(f); });
}

glm::quat rotation(const aiQuaternion& q) {
  const glm::quat turn(q.w, q.x, q.y, q.z);
  const float length = glm::length(turn);
  return length > 1e-6f && std::isfinite(length) ? turn / length : glm::quat(1, 0, 0, 0);
}

/// Assimp's keys in seconds; those that aren't finite or run backwards are left out. `rest` stands in if none is left.
template <typename Value, typename Key, typename Convert>
Keys<Value> keys(const Key* first, unsigned count, double per_second, const Value& rest, Convert convert) {
  Keys<Value> result;
  for (unsigned i = 0; i < count; ++i) {
    const auto time_s = static_cast<float>(first[i].mTime / per_second);
    const Value value = convert(first[i].mValue);
    if (!std::isfinite(time_s) || !finite(&value[0], value.length())) continue;
    if (!result.times_s.empty() && time_s < result.times_s.back()) continue;
    result.times_s.push_back(time_s);
    result.values.push_back(value);
  }
  if (result.times_s.empty()) {
    result.times_s.push_back(0);
    result.values.push_back(rest);
  }
  return result;
}

double ticks_per_second(const aiAnimation& clip) { return clip.mTicksPerSecond > 0 ? clip.mTicksPerSecond : 25.0; }

}  // namespace

RigReader::RigReader(const aiScene& scene) : scene_(scene) {
  rig_.first_influence.push_back(0);
  add_nodes(*scene.mRootNode, RigNode::kNoParent);
}

void RigReader::add_nodes(const aiNode& root, std::uint32_t no_parent) {
  std::vector<std::pair<const aiNode*, std::uint32_t>> open{{&root, no_parent}};
  while (!open.empty()) {
    const auto [node, parent] = open.back();
    open.pop_back();
    const auto number = static_cast<std::uint32_t>(rig_.nodes.size());
    RigNode added{node->mName.C_Str(), parent, matrix(node->mTransformation)};
    if (!finite(&added.parent_from_node[0][0], 16)) added.parent_from_node = glm::mat4(1);
    number_of_.emplace(node, number);
    // Bones and tracks know nodes by name only; of several they mean the one that is no mesh itself.
    const auto [known, fresh] = number_by_name_.try_emplace(added.name, number);
    if (!fresh && holds_mesh_[known->second] && node->mNumMeshes == 0) known->second = number;
    holds_mesh_.push_back(node->mNumMeshes > 0);
    rig_.nodes.push_back(std::move(added));
    for (unsigned i = node->mNumChildren; i-- > 0;) {
      if (node->mChildren[i] != nullptr) open.emplace_back(node->mChildren[i], number);
    }
  }
}

std::uint32_t RigReader::joint(std::uint32_t node, const aiMatrix4x4& node_from_bind) {
  const glm::mat4 bind = matrix(node_from_bind);
  if (!finite(&bind[0][0], 16)) throw ImportFailure{"a bone's bind matrix is not finite", kExportAgain};
  for (std::uint32_t j = 0; j < rig_.joints.size(); ++j) {
    if (rig_.joints[j].node == node && rig_.joints[j].node_from_bind == bind) return j;
  }
  rig_.joints.push_back({node, bind});
  return static_cast<std::uint32_t>(rig_.joints.size() - 1);
}

void RigReader::add_vertices(const aiMesh& mesh, const aiNode& node) {
  const auto first = static_cast<std::uint32_t>(rig_.bind_points.size());
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) rig_.bind_points.push_back(vector(mesh.mVertices[v]));
  add_influences(mesh, number_of_.at(&node));
  add_morphs(mesh, node, first);
}

void RigReader::add_influences(const aiMesh& mesh, std::uint32_t node) {
  constexpr float least = 1e-5f;
  std::vector<std::vector<Influence>> of_vertex(mesh.mNumVertices);
  for (unsigned b = 0; b < mesh.mNumBones; ++b) {
    const aiBone& bone = *mesh.mBones[b];
    const auto known = number_by_name_.find(bone.mName.C_Str());
    if (known == number_by_name_.end()) continue;
    const std::uint32_t of_bone = joint(known->second, bone.mOffsetMatrix);
    for (unsigned w = 0; w < bone.mNumWeights; ++w) {
      const aiVertexWeight& weight = bone.mWeights[w];
      if (weight.mVertexId >= mesh.mNumVertices || !(weight.mWeight > least) || !std::isfinite(weight.mWeight))
        continue;
      of_vertex[weight.mVertexId].push_back({of_bone, weight.mWeight});
    }
  }
  for (std::vector<Influence>& influences : of_vertex) {
    if (influences.empty()) influences.push_back({joint(node, aiMatrix4x4()), 1.0f});
    std::sort(influences.begin(), influences.end(),
              [](const Influence& a, const Influence& b) { return a.joint < b.joint; });
    float total = 0;
    for (const Influence& each : influences) total += each.weight;
    for (Influence& each : influences) each.weight /= total;
    rig_.influences.insert(rig_.influences.end(), influences.begin(), influences.end());
    rig_.first_influence.push_back(static_cast<std::uint32_t>(rig_.influences.size()));
  }
}

void RigReader::add_morphs(const aiMesh& mesh, const aiNode& node, std::uint32_t first_vertex) {
  if (mesh.mNumAnimMeshes == 0) return;
  morph_runs_.push_back(
      {node.mName.C_Str(), mesh.mName.C_Str(), static_cast<std::uint32_t>(rig_.morphs.size()), mesh.mNumAnimMeshes});
  for (unsigned m = 0; m < mesh.mNumAnimMeshes; ++m) {
    const aiAnimMesh& target = *mesh.mAnimMeshes[m];
    Morph morph{target.mName.C_Str(), std::isfinite(target.mWeight) ? target.mWeight : 0.0f, {}, {}};
    for (unsigned v = 0; target.mVertices != nullptr && v < std::min(target.mNumVertices, mesh.mNumVertices); ++v) {
      const glm::vec3 offset = vector(target.mVertices[v]) - vector(mesh.mVertices[v]);
      if (offset == glm::vec3(0) || !finite(&offset[0], 3)) continue;
      morph.points.push_back(first_vertex + v);
      morph.offsets.push_back(offset);
    }
    rig_.morphs.push_back(std::move(morph));
  }
}

void RigReader::add_animation(const aiAnimation& clip) {
  const double per_second = ticks_per_second(clip);
  Animation animation;
  animation.name = clip.mName.C_Str();
  animation.duration_s = std::isfinite(clip.mDuration) ? std::max(clip.mDuration / per_second, 0.0) : 0.0;
  for (unsigned c = 0; c < clip.mNumChannels; ++c) {
    const aiNodeAnim& channel = *clip.mChannels[c];
    const auto node = number_by_name_.find(channel.mNodeName.C_Str());
    if (node == number_by_name_.end()) continue;
    const glm::mat4 inverted = glm::transpose(rig_.nodes[node->second].parent_from_node);
    aiMatrix4x4 rest;
    std::copy_n(&inverted[0][0], 16, &rest.a1);
    aiVector3D scale, position;
    aiQuaternion turn;
    rest.Decompose(scale, turn, position);
    animation.tracks.push_back(
        {node->second, keys(channel.mPositionKeys, channel.mNumPositionKeys, per_second, vector(position), vector),
         keys(channel.mRotationKeys, channel.mNumRotationKeys, per_second, rotation(turn), rotation),
         keys(channel.mScalingKeys, channel.mNumScalingKeys, per_second, vector(scale), vector)});
  }
  for (unsigned c = 0; c < clip.mNumMorphMeshChannels; ++c) {
    add_morph_tracks(*clip.mMorphMeshChannels[c], per_second, animation);
  }
  rig_.animations.push_back(std::move(animation));
}

void RigReader::add_morph_tracks(const aiMeshMorphAnim& channel, double per_second, Animation& animation) const {
  // Named after the node or the mesh, with a number behind it in some formats.
  std::string name = channel.mName.C_Str();
  name = name.substr(0, name.find('*'));
  for (const MorphRun& run : morph_runs_) {
    if (run.node != name && run.mesh != name) continue;
    MorphTrack track{run.first, run.count, {}, {}};
    for (unsigned k = 0; k < channel.mNumKeys; ++k) {
      const aiMeshMorphKey& key = channel.mKeys[k];
      const auto time_s = static_cast<float>(key.mTime / per_second);
      if (!std::isfinite(time_s) || (!track.times_s.empty() && time_s < track.times_s.back())) continue;
      track.times_s.push_back(time_s);
      const std::size_t first = track.weights.size();
      track.weights.resize(first + run.count, 0.0f);
      for (unsigned w = 0; w < key.mNumValuesAndWeights; ++w) {
        const auto weight = static_cast<float>(key.mWeights[w]);
        if (key.mValues[w] < run.count && std::isfinite(weight)) track.weights[first + key.mValues[w]] = weight;
      }
    }
    if (!track.times_s.empty()) animation.morph_tracks.push_back(std::move(track));
  }
}

Rig RigReader::finish() {
  if (scene_.mNumAnimations == 0 && rig_.morphs.empty()) return {};
  for (unsigned i = 0; i < scene_.mNumAnimations; ++i) add_animation(*scene_.mAnimations[i]);
  return std::move(rig_);
}

}  // namespace rinkaku::mesh
