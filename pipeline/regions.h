#pragma once

#include <atomic>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "mesh/bounds.h"
#include "mesh/mesh.h"
#include "pipeline/passes/object_shape.h"
#include "pipeline/plan.h"

namespace rinkaku::pipeline {

struct RegionOptions {
  std::function<void(const std::string& line)> tell{};  ///< tells the user, at once; may be empty
  const std::atomic<bool>* stop = nullptr;              ///< set: no more baking, objects are drawn whole
  /// Every frame is drawn from its region's list, though it may have to be waited for (under a millisecond): the same
  /// pictures in every run. Else the whole mesh is drawn meanwhile.
  bool wait_for_lists = true;
};

/// An object's box in the world: where CG may meet it.
struct PlacedBox {
  mesh::Box box;
  glm::dmat4 world_from_object{1};
};

/// Whether a plane lies between two boxes, with a little air (a hundredth of their size).
bool are_apart(const PlacedBox& a, const PlacedBox& b);

/// What an object's regions tell of an eye, ready to be asked by ObjectShape.
///
/// The scene's file is read; where it isn't there yet, or the scene says `true`, lists are baked on both cores and kept
/// in the cache (silhouette::region_cache_folder()), which is told. `apart`: no other object may cut into this one, so
/// that the depth inside it doesn't matter.
/// Throws Error (Input) for a file that is damaged, or was baked from another mesh.
/// Precondition: region_use(object) is not None.
passes::RegionKnowledge region_knowledge(const ObjectScene& object, const mesh::Mesh& mesh, bool apart,
                                         const RegionOptions& options);

}  // namespace rinkaku::pipeline
