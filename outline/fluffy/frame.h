#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "mesh/mesh.h"
#include "mesh/topology.h"
#include "outline/fluffy/growth.h"

namespace rinkaku::fluffy {

/// A vertex of the fluffy frame: a point of the skin with what belongs to it in one chart of texture coordinates.
struct FrameVertex {
  std::uint32_t point = 0;
  glm::vec2 uv{0};
  std::array<std::uint8_t, 4> colour{};  ///< unorm, sRGB-encoded: the body's there
};

/// The fluffy frame of a mesh: the triangles that fluff grows from, and where it grows to.
///
/// In metres along the world's axes, from the object's own origin. A value: it keeps no reference to the mesh.
struct Frame {
  std::vector<glm::vec3> points;      ///< of the skin, welded
  std::vector<glm::vec3> normals;     ///< per point, unit, outwards: the mean of its faces' by their angle
  std::vector<glm::vec3> growth;      ///< per point: from the skin to the frame
  std::vector<glm::uvec3> corners;    ///< per triangle: its points
  std::vector<FrameVertex> vertices;  ///< points, once for each chart they are in
  std::vector<glm::uvec3> triangles;  ///< the same triangles, as vertices
  float longest_m = 0;                ///< of all growth
};

/// Makes the frame of the part of a mesh that `options` choose.
///
/// `world_from_object` is the linear part of the object's place: turns and scales, also uneven and mirroring ones.
/// Preconditions: `topology` is the mesh's. Throws Error (Input) naming `where` if a name in the options is nowhere in
/// the mesh, if nothing is chosen, or if vertex colours or texture coordinates are asked for that the mesh has not.
/// Cost: about 1 microsecond a triangle, with curvature or a coarser frame 2.
/// Yamachi, Shindo and Matuda, "Display Method for Fluffy Objects with Extention of Texture Mapping", 2, step 1.
Frame make_frame(const mesh::Mesh& mesh, const mesh::Topology& topology, const glm::dmat3& world_from_object,
                 const FrameOptions& options, const char* where);

}  // namespace rinkaku::fluffy
