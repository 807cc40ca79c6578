#include "silhouette/surface.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include <xxhash.h>

#include <glm/geometric.hpp>

#include "mesh/bounds.h"
#include "pipeline/frame/error.h"

namespace rinkaku::silhouette {
namespace {

/// Whether the two faces of an edge are wound alike, as turned.
bool wound_alike(const mesh::Topology& topology, const mesh::Edge& edge) {
  const bool agree = (edge.flags & mesh::Edge::kInconsistent) == 0;
  return agree == (topology.turned[edge.face0] == topology.turned[edge.face1]);
}

/// Side of a turned or unturned triangle that runs between two points.
int side_between(const glm::uvec3& triangle, std::uint32_t a, std::uint32_t b) {
  for (int side = 0; side < 3; ++side) {
    const std::uint32_t from = triangle[side];
    const std::uint32_t to = triangle[(side + 1) % 3];
    if ((from == a && to == b) || (from == b && to == a)) return side;
  }
  return -1;
}

/// Per component whether it stays two-sided though its faces were turned.
std::vector<std::uint8_t> two_sided_components(const mesh::Topology& topology) {
  std::vector<std::uint8_t> two_sided(topology.component_count, 0);
  const std::size_t two_faced = topology.consistent_edges + topology.inconsistent_edges;
  for (std::size_t e = 0; e < topology.edges.size(); ++e) {
    const mesh::Edge& edge = topology.edges[e];
    if (e >= two_faced || !wound_alike(topology, edge)) two_sided[topology.component[edge.face0]] = 1;
  }
  return two_sided;
}

void count_components(const mesh::Topology& topology, const std::vector<std::uint8_t>& two_sided, Treatment& out) {
  std::vector<std::uint8_t> turned(topology.component_count, 0);
  for (std::size_t t = 0; t < topology.faces.size(); ++t) {
    const std::uint32_t component = topology.component[t];
    if (two_sided[component]) {
      ++out.two_sided_triangles;
    } else if (topology.turned[t]) {
      turned[component] = 1;
      ++out.turned_triangles;
    }
  }
  for (std::uint32_t c = 0; c < topology.component_count; ++c) {
    ++(two_sided[c] ? out.two_sided_components : turned[c] ? out.repaired_components : out.single_sided_components);
  }
}

/// Chains the hashes of the arrays, each with its length.
template <typename T>
std::uint64_t add(const std::vector<T>& values, std::uint64_t hash) {
  return XXH3_64bits_withSeed(values.data(), values.size() * sizeof(T), hash + values.size());
}

std::uint64_t hash_of(const Surface& surface) {
  static_assert(std::endian::native == std::endian::little, "hashes in files are of little-endian values");
  std::uint64_t hash = add(surface.points, 0);
  hash = add(surface.triangles, hash);
  hash = add(surface.two_sided, hash);
  return add(surface.drawn_from_behind, hash);
}

}  // namespace

Surface make_surface(const mesh::Mesh& mesh, const mesh::Topology& topology) {
  if (mesh.triangles.empty()) throw input_error("mesh", "has no triangle", "give a mesh with a surface");
  Surface out;
  out.points = topology.points;
  out.triangles = topology.faces;
  const mesh::Sphere sphere = mesh::bounding_sphere(out.points);
  if (!(sphere.radius > 0) || !std::isfinite(sphere.radius)) {
    throw input_error("mesh", "has no size", "give a mesh with a surface");
  }
  // Inside the unit sphere for certain, whatever the rounding.
  out.frame = {sphere.centre, sphere.radius * (1 + 1e-9)};

  const std::vector<std::uint8_t> two_sided = two_sided_components(topology);
  count_components(topology, two_sided, out.treatment);
  out.two_sided.resize(out.triangles.size());
  out.drawn_from_behind.resize(out.triangles.size());
  for (std::size_t t = 0; t < out.triangles.size(); ++t) {
    out.two_sided[t] = two_sided[topology.component[t]];
    out.drawn_from_behind[t] = topology.component_two_sided[topology.component[t]];
    if (topology.turned[t]) std::swap(out.triangles[t].y, out.triangles[t].z);
  }
  for (const mesh::Part& part : mesh.parts) {
    if (!mesh.materials[part.material].two_sided) continue;
    std::fill_n(out.drawn_from_behind.begin() + part.first_triangle, part.triangle_count, std::uint8_t{1});
  }

  out.neighbours.assign(out.triangles.size(), glm::uvec3(kNone));
  const std::size_t two_faced = topology.consistent_edges + topology.inconsistent_edges;
  for (std::size_t e = 0; e < two_faced; ++e) {
    const mesh::Edge& edge = topology.edges[e];
    if (!wound_alike(topology, edge)) continue;
    out.neighbours[edge.face0][side_between(out.triangles[edge.face0], edge.a, edge.b)] = edge.face1;
    out.neighbours[edge.face1][side_between(out.triangles[edge.face1], edge.a, edge.b)] = edge.face0;
  }
  out.hash = hash_of(out);
  return out;
}

std::vector<std::uint32_t> full_list(const Surface& surface) {
  std::vector<std::uint32_t> out;
  out.reserve(surface.triangles.size() * 6);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const glm::uvec3& v = surface.triangles[t];
    out.insert(out.end(), {v.x, v.y, v.z});
    if (surface.two_sided[t]) out.insert(out.end(), {v.x, v.z, v.y});
  }
  return out;
}

double least_radius_px(const Surface& surface) {
  constexpr double least_edge_px = 32.0 / 256;
  std::vector<double> edges;
  edges.reserve(3 * surface.triangles.size());
  for (const glm::uvec3& t : surface.triangles) {
    for (int k = 0; k < 3; ++k) {
      edges.push_back(static_cast<double>(glm::distance(surface.points[t[k]], surface.points[t[(k + 1) % 3]])));
    }
  }
  const auto quarter = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 4);
  std::nth_element(edges.begin(), quarter, edges.end());
  const double edge = *quarter / surface.frame.radius;
  return edge > 0 ? least_edge_px / edge : std::numeric_limits<double>::infinity();
}

}  // namespace rinkaku::silhouette
