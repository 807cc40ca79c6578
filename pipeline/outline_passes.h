#pragma once

#include <span>

#include "mesh/mesh.h"
#include "pipeline/passes/layer_renderer.h"
#include "pipeline/scene/outline.h"

namespace rinkaku::pipeline {

/// Adds the passes that draw an object's lines: some before its body's, which are those that lie over it, some after.
/// `styled` holds the object and its body's pass. `factors` multiply widths at the mesh's welded points, for the method
/// Curvature. Needs a current GL context. Throws Error (Input) for a stroke image that can't be read.
void add_outline(passes::StyledObject& styled, const mesh::Mesh& mesh, const OutlineScene& outline,
                 std::span<const float> factors);

/// What the method Curvature multiplies widths by, per welded point of the mesh; empty for the others. No GL.
std::vector<float> line_width_factors(const mesh::Mesh& mesh, const OutlineScene& outline);

}  // namespace rinkaku::pipeline
