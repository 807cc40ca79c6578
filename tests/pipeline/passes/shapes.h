#pragma once

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "mesh/mesh.h"

// Meshes of known shape, written down directly: nothing here goes through the import stage.
namespace rinkaku::test {

inline void one_part(mesh::Mesh& mesh, const glm::vec4& colour) {
  mesh::Part part;
  part.triangle_count = static_cast<std::uint32_t>(mesh.triangles.size());
  mesh.parts = {part};
  mesh.materials.emplace_back();
  mesh.materials[0].base_colour = colour;
}

/// A unit sphere of 20 * 4^levels triangles, an icosahedron cut finer.
inline mesh::Mesh sphere(int levels, const glm::vec4& colour = glm::vec4(1)) {
  mesh::Mesh mesh;
  const float g = (1 + std::sqrt(5.0f)) / 2;
  mesh.positions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                    {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (glm::vec3& p : mesh.positions) p = glm::normalize(p);
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto fresh = static_cast<std::uint32_t>(mesh.positions.size());
      const auto [at, added] = middles.try_emplace(std::minmax(a, b), fresh);
      if (added) mesh.positions.push_back(glm::normalize(mesh.positions[a] + mesh.positions[b]));
      return at->second;
    };
    std::vector<glm::uvec3> finer;
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::uvec3 m(middle(t.x, t.y), middle(t.y, t.z), middle(t.z, t.x));
      finer.insert(finer.end(), {{t.x, m.x, m.z}, {m.x, t.y, m.y}, {m.z, m.y, t.z}, m});
    }
    mesh.triangles = std::move(finer);
  }
  mesh.normals = mesh.positions;
  mesh.point_count = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t i = 0; i < mesh.point_count; ++i) mesh.welded.push_back(i);
  one_part(mesh, colour);
  return mesh;
}

/// Adds a flat polygon: corners anticlockwise from its outer side, points given by number (for welding).
inline void add_face(mesh::Mesh& mesh, const std::vector<glm::vec3>& corners,
                     const std::vector<std::uint32_t>& points) {
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
  for (std::size_t i = 0; i < corners.size(); ++i) {
    mesh.positions.push_back(corners[i]);
    mesh.normals.push_back(normal);
    mesh.welded.push_back(points[i]);
    mesh.point_count = std::max(mesh.point_count, points[i] + 1);
  }
  for (std::uint32_t i = 2; i < corners.size(); ++i) mesh.triangles.emplace_back(base, base + i - 1, base + i);
}

/// The cube from -1 to 1 with hard edges: normals split, points welded.
inline mesh::Mesh cube(const glm::vec4& colour = glm::vec4(1)) {
  mesh::Mesh mesh;
  const auto corner = [](std::uint32_t i) { return glm::vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1); };
  const glm::uvec4 sides[] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const glm::uvec4& s : sides) {
    add_face(mesh, {corner(s.x), corner(s.y), corner(s.z), corner(s.w)}, {s.x, s.y, s.z, s.w});
  }
  one_part(mesh, colour);
  return mesh;
}

/// A regular tetrahedron in the unit sphere, with hard edges.
inline mesh::Mesh tetrahedron(const glm::vec4& colour = glm::vec4(1)) {
  mesh::Mesh mesh;
  const float s = 1 / std::sqrt(3.0f);
  const glm::vec3 corners[] = {{s, s, s}, {s, -s, -s}, {-s, s, -s}, {-s, -s, s}};
  for (const glm::uvec3& f : {glm::uvec3(0, 1, 2), glm::uvec3(0, 3, 1), glm::uvec3(0, 2, 3), glm::uvec3(1, 3, 2)}) {
    add_face(mesh, {corners[f.x], corners[f.y], corners[f.z]}, {f.x, f.y, f.z});
  }
  one_part(mesh, colour);
  return mesh;
}

/// An open square from -1 to 1 in z = 0. With a camera's axes (y down, z away) it faces a camera on its -z side, and
/// texture coordinates run from (0, 0) at its top left to (1, 1).
inline mesh::Mesh square(const glm::vec4& colour = glm::vec4(1)) {
  mesh::Mesh mesh;
  add_face(mesh, {{-1, -1, 0}, {-1, 1, 0}, {1, 1, 0}, {1, -1, 0}}, {0, 1, 2, 3});
  mesh.uvs = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  one_part(mesh, colour);
  return mesh;
}

/// Adds a mesh's triangles behind another's, moved, as parts of their own.
inline void append(mesh::Mesh& mesh, const mesh::Mesh& more, const glm::vec3& offset) {
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::size_t v = 0; v < more.positions.size(); ++v) {
    mesh.positions.push_back(more.positions[v] + offset);
    mesh.normals.push_back(more.normals[v]);
    mesh.welded.push_back(more.welded[v] + mesh.point_count);
    if (!more.uvs.empty()) mesh.uvs.push_back(more.uvs[v]);
  }
  mesh.point_count += more.point_count;
  for (mesh::Part part : more.parts) {
    part.first_triangle += static_cast<std::uint32_t>(mesh.triangles.size());
    part.material += static_cast<std::uint32_t>(mesh.materials.size());
    mesh.parts.push_back(part);
  }
  for (const glm::uvec3& t : more.triangles) mesh.triangles.push_back(t + base);
  mesh.materials.insert(mesh.materials.end(), more.materials.begin(), more.materials.end());
}

}  // namespace rinkaku::test
