#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <assimp/scene.h>

#include "mesh/rig.h"

namespace rinkaku::mesh {

/// Collects how a scene's vertices move: by the bones of their mesh, and where it has none, by their node.
class RigReader {
 public:
  explicit RigReader(const aiScene& scene);

  /// Appends a mesh's vertices. Throws ImportFailure if what moves them is not finite.
  void add_vertices(const aiMesh& mesh, const aiNode& node);

  /// The rig of all vertices in the order in which they were added; empty if the file holds neither clips nor morph
  /// targets.
  Rig finish();

 private:
  void add_nodes(const aiNode& node, std::uint32_t parent);
  std::uint32_t joint(std::uint32_t node, const aiMatrix4x4& node_from_bind);
  void add_influences(const aiMesh& mesh, std::uint32_t node);
  void add_morphs(const aiMesh& mesh, const aiNode& node, std::uint32_t first_vertex);
  void add_animation(const aiAnimation& clip);
  void add_morph_tracks(const aiMeshMorphAnim& channel, double per_second, Animation& animation) const;

  /// Morphs of one mesh at one node.
  struct MorphRun {
    std::string node, mesh;
    std::uint32_t first, count;
  };
  const aiScene& scene_;
  Rig rig_;
  std::unordered_map<const aiNode*, std::uint32_t> number_of_;
  std::unordered_map<std::string, std::uint32_t> number_by_name_;
  std::vector<bool> holds_mesh_;  // per node
  std::vector<MorphRun> morph_runs_;
};

}  // namespace rinkaku::mesh
