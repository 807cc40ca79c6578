#pragma once

#include <vector>

#include "mesh/mesh.h"
#include "pipeline/scene/object.h"

namespace rinkaku::pipeline {

/// What the outline's `weight` multiplies the line's width by at each welded point, by paint, map and material; empty
/// if none of them is asked for. `mesh` as imported, its vertex colours not replaced. Where materials meet, the mean of
/// their triangles. Throws Error (Input) if the mesh has no vertex colours, texture coordinates or material of that
/// name, or the image can't be read. Cost: some 20 ns a vertex, and reading the image.
std::vector<float> line_weights(const ObjectScene& object, const mesh::Mesh& mesh);

}  // namespace rinkaku::pipeline
