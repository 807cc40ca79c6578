#include "pipeline/passes/border_strips.h"

#include <algorithm>
#include <array>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace rinkaku::passes {
namespace {

bool look_alike(const mesh::Material& a, const mesh::Material& b) {
  return a.base_colour == b.base_colour && a.texture == b.texture && a.alpha == b.alpha;
}

// Whether the two sides are shaded by normals of their own.
bool is_crease(const mesh::Mesh& mesh, const mesh::Edge& edge) {
  constexpr float least_cos = 0.99f;  // 8 degrees: less is not seen as an edge
  for (const std::uint32_t point : {edge.a, edge.b}) {
    const glm::vec3& n0 = mesh.normals[mesh::corner_at(mesh, edge.face0, point)];
    const glm::vec3& n1 = mesh.normals[mesh::corner_at(mesh, edge.face1, point)];
    if (glm::dot(n0, n1) < least_cos) return true;
  }
  return false;
}

// In the object's coordinates, of length 1: at right angles in the world to the edge from a to b, towards `beyond`.
glm::dvec3 across(const glm::vec3& a, const glm::vec3& b, const glm::vec3& beyond, const glm::dmat3& world_from_object,
                  const glm::dmat3& object_from_world) {
  const glm::dvec3 from = world_from_object * glm::dvec3(a);
  const glm::dvec3 along = world_from_object * glm::dvec3(b) - from;
  const glm::dvec3 to = world_from_object * glm::dvec3(beyond) - from;
  const double squared = glm::dot(along, along);
  const glm::dvec3 upright = squared > 0 ? to - along * (glm::dot(to, along) / squared) : to;
  const glm::dvec3 direction = object_from_world * upright;
  const double length = glm::length(direction);
  return length > 0 ? direction / length : glm::dvec3(0);
}

}  // namespace

BorderStrips::BorderStrips(const mesh::Mesh& mesh, const mesh::Topology& topology,
                           std::span<const ShapeVertex> vertices, const glm::dmat4& world_from_object, bool creases)
    : world_from_object_(world_from_object), object_from_world_(glm::inverse(world_from_object_)) {
  const std::vector<std::uint32_t> part_of = mesh::part_of_triangles(mesh);
  struct Border {
    std::uint32_t part, edge, of, over;  // the face whose colour it has, and the one it lies on
  };
  std::vector<Border> borders;
  const std::uint32_t two_faced = topology.consistent_edges + topology.inconsistent_edges;
  for (std::uint32_t e = 0; e < two_faced; ++e) {
    const mesh::Edge& edge = topology.edges[e];
    const mesh::Part &part0 = mesh.parts[part_of[edge.face0]], &part1 = mesh.parts[part_of[edge.face1]];
    const bool alike = look_alike(mesh.materials[part0.material], mesh.materials[part1.material]);
    if (alike && !(creases && is_crease(mesh, edge))) continue;
    borders.push_back({part_of[edge.face0], e, edge.face0, edge.face1});
    borders.push_back({part_of[edge.face1], e, edge.face1, edge.face0});
  }
  std::stable_sort(borders.begin(), borders.end(), [](const Border& a, const Border& b) { return a.part < b.part; });
  for (const Border& border : borders) {
    const mesh::Edge& edge = topology.edges[border.edge];
    quads_.push_back({border.part, border.of, border.over, mesh::corner_at(mesh, border.of, edge.a),
                      mesh::corner_at(mesh, border.of, edge.b),
                      mesh::corner_at(mesh, border.over, mesh::opposite_point(topology, edge, border.over))});
  }
  vertices_.resize(quads_.size() * 4);
  move(vertices);
  indices_.reserve(quads_.size() * 6);
  runs_.reserve(mesh.parts.size());
}

void BorderStrips::append_used(std::vector<std::uint32_t>& vertices, std::vector<std::uint32_t>& positions) const {
  for (const Quad& quad : quads_) {
    vertices.insert(vertices.end(), {quad.a, quad.b});
    positions.push_back(quad.beyond);
  }
}

void BorderStrips::move(std::span<const ShapeVertex> vertices) {
  auto out = vertices_.begin();
  for (const Quad& quad : quads_) {
    std::array<std::int16_t, 4> direction =
        snorm(across(vertices[quad.a].position, vertices[quad.b].position, vertices[quad.beyond].position,
                     world_from_object_, object_from_world_));
    direction[3] = 32767 / 2;  // half a pixel over either side
    for (const std::int16_t rim : {0, 32767}) {
      for (const std::uint32_t vertex : {quad.a, quad.b}) {
        *out = {vertices[vertex], direction};
        out->shape.outline_normal[3] = rim;
        ++out;
      }
    }
  }
}

void BorderStrips::mark_triangles(std::vector<std::uint8_t>& mask) const {
  for (const Quad& quad : quads_) mask[quad.face0] = mask[quad.face1] = 1;
}

void BorderStrips::collect(const mesh::Contour& contour) {
  indices_.clear();
  runs_.clear();
  for (std::uint32_t q = 0; q < quads_.size(); ++q) {
    const Quad& quad = quads_[q];
    if (contour.front[quad.face0] == 0 || contour.front[quad.face1] == 0) continue;
    append_quad(quad.part, 4 * q, indices_, runs_);
  }
}

}  // namespace rinkaku::passes
