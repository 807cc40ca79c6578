#pragma once

#include <memory>
#include <optional>

#include <glm/mat4x4.hpp>

#include "mesh/mesh.h"
#include "mesh/pose.h"
#include "mesh/rig.h"
#include "pipeline/passes/layer_renderer.h"
#include "pipeline/passes/toon/toon_pass.h"
#include "pipeline/scene/outline.h"

namespace rinkaku::pipeline {

/// What a mesh that is drawn by itself plays, by the clock of the views.
struct LoneMotion {
  const mesh::Rig* rig = nullptr;  ///< the mesh's; null: it stands still
  mesh::Playback playback{};
};

/// Draws a mesh by itself, without a scene: toon-shaded, with a line if there is one. Needs a current GL context.
std::unique_ptr<passes::LayerRenderer> lone_mesh(const mesh::Mesh& mesh, const glm::dmat4& world_from_mesh,
                                                 const passes::ToonOptions& toon,
                                                 const std::optional<OutlineScene>& line,
                                                 const passes::PixelRect& picture, const LoneMotion& motion = {});

}  // namespace rinkaku::pipeline
