#pragma once

#include <vector>

#include <glm/vec4.hpp>

#include "mesh/mesh.h"

namespace rinkaku::fluffy {

/// Per vertex of a mesh: the colour its body has around there, from materials, textures and vertex colours;
/// sRGB-encoded with straight alpha. A texture's is the mean of a few places in the triangles at the vertex. Cost:
/// about 0.1 microseconds a triangle.
std::vector<glm::vec4> body_colours(const mesh::Mesh& mesh);

}  // namespace rinkaku::fluffy
