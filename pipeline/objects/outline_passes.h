#pragma once

#include <span>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

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
struct LineSurroundings {
  glm::dmat4 world_from_object{1};
  glm::dvec3 light{0, 0, 1};         ///< towards the light, in the world; need not be of unit length
  std::span<const float> weights{};  ///< what line_weights() gave
  bool moves = false;
};
passes::LineStyle line_style(const mesh::Mesh& mesh, const OutlineScene& outline, const LineSurroundings& around,
                             std::vector<float>& factors);

}  // namespace rinkaku::pipeline
