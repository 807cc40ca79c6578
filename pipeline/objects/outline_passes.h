#pragma once

#include <vector>

#include <glm/mat4x4.hpp>

#include "mesh/mesh.h"
#include "pipeline/passes/layer_renderer.h"
#include "pipeline/scene/outline.h"

namespace rinkaku::pipeline {

/// Adds the passes that draw an object's lines: some before its body's, which are those that lie over it, some after.
/// `styled` holds the object and its body's pass. `style` is what line_style() gave. Needs a current GL context. Throws
/// Error (Input) for a stroke image that can't be read.
void add_outline(passes::StyledObject& styled, const mesh::Mesh& mesh, const OutlineScene& outline,
                 const passes::LineStyle& style);

/// What varies along an object's line: how it ends, and how it follows the shape, found once in `factors` (per welded
/// point of the mesh, empty where it is even), or in every frame if the object moves. No GL.
passes::LineStyle line_style(const mesh::Mesh& mesh, const glm::dmat4& world_from_object, const OutlineScene& outline,
                             bool moves, std::vector<float>& factors);

}  // namespace rinkaku::pipeline
