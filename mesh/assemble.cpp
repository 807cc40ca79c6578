#include "mesh/assemble.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include <meshoptimizer.h>

#include <glm/geometric.hpp>

#include "mesh/bind_rig.h"
#include "mesh/crease_normals.h"

namespace rinkaku::mesh {
namespace {

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Keeps the triangles that `keep` accepts and moves the parts along.
template <typename Keep>
void filter_triangles(std::vector<glm::uvec3>& triangles, std::vector<Part>& parts, Keep keep) {
  std::uint32_t out = 0;
  for (Part& part : parts) {
    const std::uint32_t first = part.first_triangle;
    const std::uint32_t end = first + part.triangle_count;
    part.first_triangle = out;
    for (std::uint32_t t = first; t < end; ++t) {
      if (keep(triangles[t])) triangles[out++] = triangles[t];
    }
    part.triangle_count = out - part.first_triangle;
  }
  triangles.resize(out);
  std::erase_if(parts, [](const Part& part) { return part.triangle_count == 0; });
}

void drop_broken(Soup& soup, Dropped& dropped) {
  std::vector<std::uint8_t> used(soup.positions.size(), 0);
  filter_triangles(soup.triangles, soup.parts, [&](const glm::uvec3& t) {
    for (int c = 0; c < 3; ++c) {
      if (t[c] >= soup.positions.size()) {
        ++dropped.bad_index;
        return false;
      }
    }
    for (int c = 0; c < 3; ++c) used[t[c]] = 1;
    if (finite(soup.positions[t.x]) && finite(soup.positions[t.y]) && finite(soup.positions[t.z])) return true;
    ++dropped.non_finite;
    return false;
  });
  dropped.unused_vertices = static_cast<std::uint64_t>(std::count(used.begin(), used.end(), 0));
}

/// For each vertex the number of its position; `count` is how many there are.
std::vector<std::uint32_t> weld(std::vector<glm::vec3>& positions, std::size_t& count) {
  for (glm::vec3& p : positions) p += 0.0f;  // -0 becomes 0, as positions are compared bit by bit
  std::vector<std::uint32_t> point(positions.size());
  count = meshopt_generateVertexRemap(point.data(), nullptr, positions.size(), positions.data(), positions.size(),
                                      sizeof(glm::vec3));
  return point;
}

/// Everything a vertex is made of, without padding, so that equal ones are equal bit by bit.
struct Vertex {
  std::uint32_t point;
  glm::vec3 normal;
  glm::vec2 uv;
  glm::vec4 colour;
};
static_assert(sizeof(Vertex) == 40);

/// One vertex a corner.
std::vector<Vertex> corners(const Soup& soup, const std::vector<glm::uvec3>& faces,
                            const std::vector<glm::vec3>& computed) {
  std::vector<Vertex> result(faces.size() * 3);
  for (std::size_t i = 0; i < result.size(); ++i) {
    const int c = static_cast<int>(i % 3);
    const std::uint32_t v = soup.triangles[i / 3][c];
    Vertex& vertex = result[i];
    vertex.point = faces[i / 3][c];
    const glm::vec3 given = soup.normals.empty() ? glm::vec3(0) : soup.normals[v];
    const float length = glm::length(given);
    vertex.normal = (std::isfinite(length) && length > 1e-6f ? given / length : computed[i]) + 0.0f;
    const glm::vec2 uv = soup.uvs.empty() ? glm::vec2(0) : soup.uvs[v];
    vertex.uv = std::isfinite(uv.x) && std::isfinite(uv.y) ? uv + 0.0f : glm::vec2(0);
    vertex.colour = soup.colours.empty() ? glm::vec4(0) : soup.colours[v];
    for (int k = 0; k < 4; ++k) {
      const float value = vertex.colour[k];
      vertex.colour[k] = value > 0 ? std::min(value, 1.0f) : 0.0f;  // NaN becomes 0
    }
  }
  return result;
}

/// Orders each part's triangles for the vertex cache. Each part is numbered compactly for it, so that many small parts
/// cost no more than one large one.
void order_triangles(const std::vector<Part>& parts, std::size_t vertex_count, std::vector<std::uint32_t>& indices) {
  std::vector<std::uint32_t> local(vertex_count, ~0u);
  std::vector<std::uint32_t> global;
  std::vector<std::uint32_t> compact;
  for (const Part& part : parts) {
    const auto first = indices.begin() + std::ptrdiff_t{part.first_triangle} * 3;
    const auto end = first + std::ptrdiff_t{part.triangle_count} * 3;
    global.clear();
    compact.clear();
    for (auto i = first; i != end; ++i) {
      if (local[*i] == ~0u) {
        local[*i] = static_cast<std::uint32_t>(global.size());
        global.push_back(*i);
      }
      compact.push_back(local[*i]);
    }
    meshopt_optimizeVertexCache(compact.data(), compact.data(), compact.size(), global.size());
    std::transform(compact.begin(), compact.end(), first, [&](std::uint32_t i) { return global[i]; });
    for (const std::uint32_t v : global) local[v] = ~0u;
  }
}

/// Unpacks the vertices, with points numbered anew in order of first use. Returns the old number of each.
std::vector<std::uint32_t> store_vertices(const Soup& soup, const std::vector<Vertex>& vertices,
                                          const std::vector<glm::vec3>& point_positions, Mesh& mesh) {
  const std::size_t count = vertices.size();
  mesh.positions.resize(count);
  mesh.normals.resize(count);
  mesh.welded.resize(count);
  if (!soup.uvs.empty()) mesh.uvs.resize(count);
  if (!soup.colours.empty()) mesh.colours.resize(count);
  std::vector<std::uint32_t> renumbered(point_positions.size(), ~0u);
  std::vector<std::uint32_t> old_number;
  for (std::size_t v = 0; v < count; ++v) {
    std::uint32_t& point = renumbered[vertices[v].point];
    if (point == ~0u) {
      point = mesh.point_count++;
      old_number.push_back(vertices[v].point);
    }
    mesh.welded[v] = point;
    mesh.positions[v] = point_positions[vertices[v].point];
    mesh.normals[v] = vertices[v].normal;
    if (!soup.uvs.empty()) mesh.uvs[v] = vertices[v].uv;
    if (!soup.colours.empty()) mesh.colours[v] = vertices[v].colour;
  }
  return old_number;
}

}  // namespace

Assembled assemble(Soup soup, double crease_deg) {
  Assembled result;
  Mesh& mesh = result.mesh;
  drop_broken(soup, result.dropped);

  std::size_t point_count = 0;
  auto point = weld(soup.positions, point_count);
  if (!soup.rig.empty()) split_by_movement(soup.rig, point, point_count);
  std::vector<glm::vec3> point_positions(point_count);
  std::vector<std::uint32_t> vertex_of(point_count);  // any one
  for (std::uint32_t v = 0; v < point.size(); ++v) {
    point_positions[point[v]] = soup.positions[v];
    vertex_of[point[v]] = v;
  }

  filter_triangles(soup.triangles, soup.parts, [&](const glm::uvec3& t) {
    const bool whole = point[t.x] != point[t.y] && point[t.y] != point[t.z] && point[t.z] != point[t.x];
    if (!whole) ++result.dropped.collapsed;
    return whole;
  });
  std::vector<glm::uvec3> faces(soup.triangles.size());
  for (std::size_t t = 0; t < faces.size(); ++t) {
    const glm::uvec3& v = soup.triangles[t];
    faces[t] = {point[v.x], point[v.y], point[v.z]};
  }

  mesh.parts = std::move(soup.parts);
  mesh.materials = std::move(soup.materials);
  mesh.textures = std::move(soup.textures);
  if (mesh.materials.empty()) mesh.materials.emplace_back();
  if (faces.empty()) return result;

  const auto computed = crease_normals(point_positions, faces, crease_deg);
  std::vector<Vertex> vertices = corners(soup, faces, computed);
  const std::size_t index_count = vertices.size();
  std::vector<std::uint32_t> remap(index_count);
  const std::size_t unique =
      meshopt_generateVertexRemap(remap.data(), nullptr, index_count, vertices.data(), index_count, sizeof(Vertex));
  std::vector<Vertex> merged(unique);
  meshopt_remapVertexBuffer(merged.data(), vertices.data(), index_count, sizeof(Vertex), remap.data());

  std::vector<std::uint32_t> indices = std::move(remap);  // corners were numbered 0, 1, 2, ..., so it is the index list
  order_triangles(mesh.parts, unique, indices);
  vertices.resize(unique);
  meshopt_optimizeVertexFetch(vertices.data(), indices.data(), index_count, merged.data(), unique, sizeof(Vertex));

  mesh.triangles.resize(index_count / 3);
  std::memcpy(mesh.triangles.data(), indices.data(), index_count * sizeof(std::uint32_t));
  std::vector<std::uint32_t> stand_ins = store_vertices(soup, vertices, point_positions, mesh);
  if (soup.rig.empty()) return result;
  for (std::uint32_t& each : stand_ins) each = vertex_of[each];
  result.rig = rig_of_points(std::move(soup.rig), stand_ins);
  return result;
}

}  // namespace rinkaku::mesh
