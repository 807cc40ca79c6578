#include "pipeline/passes/drawn_object.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "mesh/bounds.h"
#include "mesh/levels.h"
#include "mesh/topology.h"

namespace rinkaku::passes {
namespace {

using Snorm4 = std::array<std::int16_t, 4>;

Snorm4 snorm(const glm::vec3& v, float w) {
  auto code = [](float f) { return static_cast<std::int16_t>(std::lround(std::clamp(f, -1.0f, 1.0f) * 32767.0f)); };
  return {code(v.x), code(v.y), code(v.z), code(w)};
}

std::array<std::uint8_t, 4> unorm(const glm::vec4& v) {
  auto code = [](float f) { return static_cast<std::uint8_t>(std::lround(std::clamp(f, 0.0f, 1.0f) * 255.0f)); };
  return {code(v.x), code(v.y), code(v.z), code(v.w)};
}

// The corner of a triangle that lies on a welded point.
std::uint32_t corner_at(const mesh::Mesh& mesh, std::uint32_t face, std::uint32_t point) {
  const glm::uvec3& t = mesh.triangles[face];
  for (int k = 0; k < 3; ++k) {
    if (mesh.welded[t[k]] == point) return t[k];
  }
  return t.x;
}

// Whether a surface bends towards its outer side at an edge. Of a closed surface, the contour there is never seen: what
// faces away lies before what faces the eye.
bool is_hollow(const mesh::Topology& topology, const mesh::Edge& edge) {
  if ((edge.flags & (mesh::Edge::kNonManifold | mesh::Edge::kInconsistent)) != 0) return false;
  if (topology.component_two_sided[topology.component[edge.face0]] != 0) return false;
  const glm::uvec3& other = topology.faces[edge.face1];
  const std::uint32_t opposite = other.x + other.y + other.z - edge.a - edge.b;
  const glm::vec3 away = topology.points[opposite] - topology.points[edge.a];
  constexpr float least = 1e-4f;  // of the length: flat within rounding counts as convex
  return glm::dot(topology.face_normals[edge.face0], away) > least * glm::length(away);
}

}  // namespace

DrawnObject::DrawnObject(const mesh::Mesh& mesh, const glm::dmat4& world_from_object)
    : world_from_object_(world_from_object),
      object_from_world_(glm::inverse(world_from_object)),
      world_from_normal_(glm::transpose(glm::inverse(glm::dmat3(world_from_object)))),
      mirrored_(glm::determinant(glm::dmat3(world_from_object)) < 0),
      mesh_array_(make_vertex_array()),
      contour_array_(make_vertex_array()) {
  for (int axis = 0; axis < 3; ++axis) {
    largest_scale_ = std::max(largest_scale_, glm::length(glm::dvec3(world_from_object[axis])));
  }
  centre_ = glm::dvec3(world_from_object * glm::dvec4(mesh::bounding_box(mesh.positions).centre(), 1.0));
  const mesh::Topology topology = mesh::topology(mesh);
  for (std::uint8_t flag : topology.component_two_sided) two_sided_ = two_sided_ || flag != 0;
  for (const mesh::Part& part : mesh.parts) two_sided_ = two_sided_ || mesh.materials[part.material].two_sided;
  collect_vertices(mesh, topology);
  collect_edges(mesh, topology);
  levels_.push_back({0, mesh::ContourFinder(mesh, topology)});
  mesh::Mesh coarse = mesh;
  for (mesh::Level& level : mesh::levels(mesh)) {
    coarse.triangles = std::move(level.triangles);
    coarse.parts = std::move(level.parts);
    levels_.push_back({level.error, mesh::ContourFinder(coarse, mesh::topology(coarse))});
  }
  vertex_buffer_ = gl::StaticBuffer(std::as_bytes(std::span(vertices_)));
  glVertexArrayVertexBuffer(mesh_array_.name(), 0, vertex_buffer_.name(), 0, sizeof(Vertex));
}

void DrawnObject::collect_vertices(const mesh::Mesh& mesh, const mesh::Topology& topology) {
  // Outline normals are unit vectors in the world, brought back to the object's coordinates, so that uneven scales push
  // at right angles to the surface as well. The longest is made 1, as the vertex format needs it.
  const glm::dmat3 object_from_world_linear(object_from_world_);
  std::vector<glm::dvec3> push(topology.outline_normals.size());
  double longest = 0;
  for (std::size_t p = 0; p < push.size(); ++p) {
    push[p] = object_from_world_linear *
              glm::normalize(glm::dmat3(world_from_normal_) * glm::dvec3(topology.outline_normals[p]));
    longest = std::max(longest, glm::length(push[p]));
  }
  push_m_ = 1 / longest;
  vertices_.resize(mesh.positions.size());
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    Vertex& out = vertices_[v];
    out.position = mesh.positions[v];
    out.normal = snorm(mesh.normals[v], 0);
    out.outline_normal = snorm(glm::vec3(push[mesh.welded[v]] * push_m_), 0);
    out.uv = mesh.uvs.empty() ? glm::vec2(0) : mesh.uvs[v];
    out.colour = unorm(mesh.colours.empty() ? glm::vec4(1) : mesh.colours[v]);
  }
  for (const glm::vec3& p : topology.points) {
    x_.push_back(p.x);
    y_.push_back(p.y);
    z_.push_back(p.z);
  }
}

void DrawnObject::collect_edges(const mesh::Mesh& mesh, const mesh::Topology& topology) {
  std::vector<std::uint32_t> part_of(mesh.triangles.size());
  for (std::uint32_t p = 0; p < mesh.parts.size(); ++p) {
    std::fill_n(part_of.begin() + mesh.parts[p].first_triangle, mesh.parts[p].triangle_count, p);
  }
  edges_.reserve(topology.edges.size());
  for (const mesh::Edge& edge : topology.edges) {
    EdgeVertices e{edge.vertex_a,       edge.vertex_b, edge.vertex_a, edge.vertex_b, part_of[edge.face0],
                   part_of[edge.face0], edge.face0,    edge.face0,    false};
    if (edge.face1 != mesh::kNone) {
      e.a1 = corner_at(mesh, edge.face1, edge.a);
      e.b1 = corner_at(mesh, edge.face1, edge.b);
      e.part1 = part_of[edge.face1];
      e.face1 = edge.face1;
      e.always_hidden = !two_sided_ && is_hollow(topology, edge);
    }
    edges_.push_back(e);
  }
}

gl::VertexArrayHandle DrawnObject::make_vertex_array() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  auto attribute = [name](GLuint location, GLint size, GLenum type, GLboolean normalised, std::size_t offset) {
    glEnableVertexArrayAttrib(name, location);
    glVertexArrayAttribFormat(name, location, size, type, normalised, static_cast<GLuint>(offset));
    glVertexArrayAttribBinding(name, location, 0);
  };
  attribute(0, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, position));
  attribute(1, 3, GL_SHORT, GL_TRUE, offsetof(Vertex, normal));
  attribute(2, 4, GL_SHORT, GL_TRUE, offsetof(Vertex, outline_normal));
  attribute(3, 2, GL_FLOAT, GL_FALSE, offsetof(Vertex, uv));
  attribute(4, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, colour));
  return gl::VertexArrayHandle(name);
}

const Look& DrawnObject::look(const View& view, const PixelRect& picture) {
  look_ = {};
  find_bounds(view, picture);
  if (!look_.visible) return look_;
  const RigidTransform world_from_camera = inverse(view.camera_from_world);
  look_.distance_m = glm::length(centre_ - world_from_camera.translation_m);
  const glm::dvec3 eye = glm::dvec3(object_from_world_ * glm::dvec4(world_from_camera.translation_m, 1.0));
  SurfaceLevel& surface = surface_for(view);
  const bool whole = &surface == &levels_.front();
  look_.contour = &levels_.front().finder.find(eye, {.front = whole, .back = false, .edges = true});
  look_.surface = whole ? look_.contour : &surface.finder.find(eye, {.front = true, .back = false, .edges = false});
  look_.overlap_px = whole ? 0.0f : 1.0f;
  return look_;
}

DrawnObject::SurfaceLevel& DrawnObject::surface_for(const View& view) {
  constexpr double most_px = 0.5;
  if (look_.crosses_eye_plane) return levels_.front();
  // The most that one of the mesh's units takes, along the axis that is stretched most.
  const double px_per_unit = view.camera.fx_px * largest_scale_ / nearest_m_;
  std::size_t level = 0;
  while (level + 1 < levels_.size() && levels_[level + 1].error * px_per_unit <= most_px) ++level;
  return levels_[level];
}

void DrawnObject::find_bounds(const View& view, const PixelRect& picture) {
  const glm::dmat4 camera_from_object = to_matrix(view.camera_from_world) * world_from_object_;
  // Rows of pixel * Z, pixel * Z and Z.
  const glm::dmat4 t = glm::transpose(camera_from_object);
  const CameraModel& camera = view.camera;
  const glm::vec4 row_x(camera.fx_px * t[0] + camera.cx_px * t[2]), row_y(camera.fy_px * t[1] + camera.cy_px * t[2]),
      row_z(t[2]);
  float left = 1e30f, right = -1e30f, top = 1e30f, bottom = -1e30f, nearest = 1e30f, farthest = -1e30f;
  for (std::size_t i = 0; i < x_.size(); ++i) {
    const float x = x_[i], y = y_[i], z = z_[i];
    const float depth = row_z.x * x + row_z.y * y + row_z.z * z + row_z.w;
    const float inverse_depth = 1.0f / depth;
    const float px = (row_x.x * x + row_x.y * y + row_x.z * z + row_x.w) * inverse_depth;
    const float py = (row_y.x * x + row_y.y * y + row_y.z * z + row_y.w) * inverse_depth;
    left = px < left ? px : left;
    right = px > right ? px : right;
    top = py < top ? py : top;
    bottom = py > bottom ? py : bottom;
    nearest = depth < nearest ? depth : nearest;
    farthest = depth > farthest ? depth : farthest;
  }
  if (!(farthest > near_m)) return;  // behind the camera, or no point at all
  nearest_m_ = nearest;
  look_.crosses_eye_plane = !(nearest > near_m);
  if (look_.crosses_eye_plane) {
    look_.bounds = picture;
  } else {
    const auto whole = [](float px) { return static_cast<int>(std::clamp(px, -1e8f, 1e8f)); };
    const PixelRect box{whole(std::floor(left)), whole(std::floor(top)), 0, 0};
    look_.bounds = {box.x_px, box.y_px, whole(std::ceil(right)) + 1 - box.x_px,
                    whole(std::ceil(bottom)) + 1 - box.y_px};
  }
  look_.visible = true;
}

void DrawnObject::collect_contour() {
  const mesh::Contour& contour = *look_.contour;
  contour_vertices_.clear();
  quad_indices_.clear();
  contour_runs_.clear();
  contour_order_.clear();
  for (std::uint32_t edge : contour.edges) {
    if (!edges_[edge].always_hidden) contour_order_.push_back(edge);
  }
  auto from_face0 = [&](const EdgeVertices& e) { return contour.front[e.face0] != 0 || contour.front[e.face1] == 0; };
  auto part_of = [&](std::uint32_t edge) {
    const EdgeVertices& e = edges_[edge];
    return from_face0(e) ? e.part0 : e.part1;
  };
  if (look_.contour->front_parts.size() > 1) {
    std::sort(contour_order_.begin(), contour_order_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return std::pair(part_of(a), a) < std::pair(part_of(b), b); });
  }
  for (std::uint32_t edge : contour_order_) {
    const EdgeVertices& e = edges_[edge];
    const bool first = from_face0(e);
    const std::uint32_t part = first ? e.part0 : e.part1;
    if (contour_runs_.empty() || contour_runs_.back().part != part) {
      contour_runs_.push_back({part, static_cast<std::uint32_t>(quad_indices_.size()), 0});
    }
    Vertex a = vertices_[first ? e.a0 : e.a1], b = vertices_[first ? e.b0 : e.b1];
    if (contour.front[first ? e.face0 : e.face1] == 0) {
      // Seen from its back, as the border of an open surface may be.
      for (int k = 0; k < 3; ++k) {
        a.normal[k] = static_cast<std::int16_t>(-a.normal[k]);
        b.normal[k] = static_cast<std::int16_t>(-b.normal[k]);
      }
    }
    const auto base = static_cast<std::uint32_t>(contour_vertices_.size());
    contour_vertices_.push_back(a);
    contour_vertices_.push_back(b);
    a.outline_normal[3] = b.outline_normal[3] = 32767;
    contour_vertices_.push_back(a);
    contour_vertices_.push_back(b);
    for (std::uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u}) quad_indices_.push_back(base + corner);
    contour_runs_.back().index_count += 6;
  }
}

void DrawnObject::upload() {
  front_buffer_.write(std::as_bytes(look_.surface->front_indices));
  front_runs_.clear();
  for (std::uint32_t p = 0; p < look_.surface->front_parts.size(); ++p) {
    const mesh::IndexRange& range = look_.surface->front_parts[p];
    if (range.count > 0) front_runs_.push_back({p, range.first, range.count});
  }
  collect_contour();
  contour_buffer_.write(std::as_bytes(std::span(contour_vertices_)));
  quad_buffer_.write(std::as_bytes(std::span(quad_indices_)));
  glVertexArrayElementBuffer(mesh_array_.name(), front_buffer_.name());
  glVertexArrayElementBuffer(contour_array_.name(), quad_buffer_.name());
  glVertexArrayVertexBuffer(contour_array_.name(), 0, contour_buffer_.name(), 0, sizeof(Vertex));
}

std::span<const DrawnObject::Run> DrawnObject::bind_front() {
  glFrontFace(mirrored_ ? GL_CCW : GL_CW);  // window rows run downwards (see clip_from_camera)
  glBindVertexArray(mesh_array_.name());
  return front_runs_;
}

std::span<const DrawnObject::Run> DrawnObject::bind_contour() {
  glBindVertexArray(contour_array_.name());
  return contour_runs_;
}

}  // namespace rinkaku::passes
