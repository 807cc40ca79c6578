#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "mesh/mesh.h"
#include "mesh/rig.h"

namespace rinkaku::mesh {

/// Triangles as a file holds them: neither welded nor checked.
struct Soup {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  ///< per vertex, or empty; a zero or NaN one is missing and gets computed
  std::vector<glm::vec2> uvs;      ///< per vertex, or empty; (0, 0) is the texture's top left
  std::vector<glm::vec4> colours;  ///< per vertex, or empty
  std::vector<glm::uvec3> triangles;
  std::vector<Part> parts;  ///< cover all triangles, in order
  std::vector<Material> materials;
  std::vector<Texture> textures;
  Rig rig;  ///< per vertex; empty for what doesn't move
};

/// How many triangles were left out, and why.
struct Dropped {
  std::uint64_t non_finite = 0;
  std::uint64_t bad_index = 0;
  std::uint64_t collapsed = 0;
  std::uint64_t unused_vertices = 0;
};

struct Assembled {
  Mesh mesh;
  Rig rig;
  Dropped dropped;
};

/// Makes a drawable mesh of a soup: broken triangles dropped, vertices at exactly one position (with -0 = 0) welded
/// into points, missing normals computed with the crease angle, equal vertices merged, triangles ordered for the vertex
/// cache within their part, vertices and points in order of first use. Parts left empty go. Vertices that move
/// differently are not welded.
/// The mesh has no triangles if nothing was left.
Assembled assemble(Soup soup, double crease_deg);

}  // namespace rinkaku::mesh
