#pragma once

#include <memory>
#include <optional>

#include <glm/mat4x4.hpp>

#include "mesh/mesh.h"
#include "pipeline/passes/layer_renderer.h"
#include "pipeline/passes/toon/toon_pass.h"
#include "pipeline/scene/outline.h"

namespace rinkaku::pipeline {

/// Draws a mesh by itself, without a scene: toon-shaded, with a line if there is one. Needs a current GL context.
std::unique_ptr<passes::LayerRenderer> lone_mesh(const mesh::Mesh& mesh, const glm::dmat4& world_from_mesh,
                                                 const passes::ToonOptions& toon,
                                                 const std::optional<OutlineScene>& line,
                                                 const passes::PixelRect& picture);

}  // namespace rinkaku::pipeline
