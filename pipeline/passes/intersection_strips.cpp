#include "pipeline/passes/intersection_strips.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace rinkaku::passes {
namespace {

glm::dvec3 unit(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : glm::dvec3(0);
}

// How a point moves on the picture, in pixels, all in the camera's frame.
glm::dvec2 seen_way_px(const glm::dvec2& focal_px, const glm::dvec3& position, const glm::dvec3& way) {
  return focal_px * (glm::dvec2(way) - glm::dvec2(position) * (way.z / position.z)) / position.z;
}

// How far a surface is drawn from where it is: as pushed() in screen_offset.glsl moves it, in the camera's frame.
glm::dvec3 inset(const glm::dvec2& focal_px, const glm::dvec3& position, const glm::dvec3& outline_normal) {
  const glm::dvec2 per_m = seen_way_px(focal_px, position, outline_normal);
  const double most_per_m = focal_px.x / position.z;
  const glm::dvec2 way_px = per_m * (-feather_px / std::max(glm::length(per_m), most_per_m));
  return {way_px * position.z / focal_px, 0.0};
}

// The way from a point of two planes' line to the line that they share once each has moved by its offset along its
// normal.
glm::dvec3 way_to_moved_line(const std::array<glm::dvec3, 2>& normals, const std::array<double, 2>& offset) {
  const double cosine = glm::dot(normals[0], normals[1]);
  const double sine2 = 1 - cosine * cosine;
  constexpr double least_sine2 = 1e-4;  // nearly the same plane
  if (sine2 < least_sine2) return normals[0] * offset[0];
  return (normals[0] * (offset[0] - cosine * offset[1]) + normals[1] * (offset[1] - cosine * offset[0])) / sine2;
}

ShapeVertex interpolated(const mesh::Mesh& mesh, const glm::uvec3& t, const glm::dvec3& weights) {
  const auto mean = [&](const auto& values) {
    const glm::vec3 w(weights);
    return values[t.x] * w.x + values[t.y] * w.y + values[t.z] * w.z;
  };
  ShapeVertex v;
  v.normal = snorm(unit(glm::dvec3(mean(mesh.normals))));
  if (!mesh.uvs.empty()) v.uv = mean(mesh.uvs);
  v.colour = unorm(mesh.colours.empty() ? glm::vec4(1) : mean(mesh.colours));
  return v;
}

}  // namespace

// The camera as the shaders' pushed() sees it.
struct IntersectionStrips::Eye {
  glm::dmat3 camera_from_world, world_from_camera;
  glm::dvec3 translation_m;
  glm::dvec2 focal_px;
};

IntersectionStrips::IntersectionStrips(const mesh::Mesh& mesh, const mesh::Topology& topology,
                                       std::span<const mesh::Cut> cuts, const glm::dmat4& world_from_object)
    : world_from_object_(world_from_object), object_from_world_(glm::inverse(world_from_object)) {
  if (cuts.empty()) return;
  const std::vector<std::uint32_t> part_of = mesh::part_of_triangles(mesh);
  const glm::dmat3 world_from_normal = glm::transpose(glm::dmat3(object_from_world_));
  std::vector<std::uint32_t> number_of(topology.points.size(), mesh::kNone);
  const auto number = [&](std::uint32_t point) {
    if (number_of[point] == mesh::kNone) {
      number_of[point] = static_cast<std::uint32_t>(points_.size());
      points_.push_back({glm::dvec3(world_from_object * glm::dvec4(topology.points[point], 1)),
                         unit(world_from_normal * glm::dvec3(topology.outline_normals[point])), point});
    }
    return number_of[point];
  };
  for (const mesh::Cut& cut : cuts) {
    TwoFaces two;
    for (int side : {0, 1}) {
      Side& out = two.sides[side];
      out.face = cut.faces[side];
      out.two_sided = topology.component_two_sided[topology.component[out.face]] != 0 ||
                      mesh.materials[mesh.parts[part_of[out.face]].material].two_sided;
      out.normal = unit(world_from_normal * glm::dvec3(topology.face_normals[out.face]));
      for (int k = 0; k < 3; ++k) out.corners[k] = number(topology.faces[out.face][k]);
      out.weights = cut.weights[side];
    }
    for (int end : {0, 1}) two.ends_m[end] = glm::dvec3(world_from_object * glm::dvec4(cut.ends[end], 1));
    two.across = across(two, 0);
    cuts_.push_back(two);
    for (int of : {0, 1}) add_quad(mesh, cut, of, part_of[cut.faces[of]]);
  }
  std::stable_sort(quads_.begin(), quads_.end(), [](const Quad& a, const Quad& b) { return a.part < b.part; });
  drawn_points_.resize(points_.size());
  placed_.resize(cuts_.size());
  vertices_.reserve(quads_.size() * 4);
  indices_.reserve(quads_.size() * 6);
  runs_.reserve(mesh.parts.size());
}

// In the plane of the other face, at right angles to the line, to the outer side of this one.
glm::dvec3 IntersectionStrips::across(const TwoFaces& two, int of) {
  const glm::dvec3 upright = glm::cross(two.ends_m[1] - two.ends_m[0], two.sides[1 - of].normal);
  return glm::dot(upright, two.sides[of].normal) < 0 ? -upright : upright;
}

void IntersectionStrips::add_quad(const mesh::Mesh& mesh, const mesh::Cut& cut, int of, std::uint32_t part) {
  const glm::dvec3 direction = glm::dmat3(object_from_world_) * across(cuts_.back(), of);
  Quad quad{part, static_cast<std::uint32_t>(cuts_.size() - 1), of, {}, mesh.triangles[cut.faces[of]]};
  for (int end = 0; end < 2; ++end) {
    quad.ends[end].shape = interpolated(mesh, mesh.triangles[cut.faces[of]], cut.weights[of][end]);
    quad.ends[end].across = snorm(unit(direction));
  }
  quads_.push_back(quad);
}

void IntersectionStrips::append_used(std::span<const std::uint32_t> welded, std::vector<std::uint32_t>& points) const {
  for (const Point& p : points_) points.push_back(p.number);
  for (const Quad& quad : quads_) {
    for (int k = 0; k < 3; ++k) points.push_back(welded[quad.corners[k]]);
  }
}

void IntersectionStrips::move(std::span<const glm::vec3> points, std::span<const glm::vec3> outline_normals,
                              std::span<const ShapeVertex> vertices) {
  const glm::dmat3 world_from_normal = glm::transpose(glm::dmat3(object_from_world_));
  for (Point& p : points_) {
    p.position_m = glm::dvec3(world_from_object_ * glm::dvec4(points[p.number], 1));
    p.outline_normal = unit(world_from_normal * glm::dvec3(outline_normals[p.number]));
  }
  for (TwoFaces& two : cuts_) {
    std::array<std::array<glm::dvec3, 2>, 2> ends_m;  // of the sides, then
    for (int side : {0, 1}) {
      Side& s = two.sides[side];
      const auto corner = [&](int k) { return glm::dvec3(points[points_[s.corners[k]].number]); };
      s.normal = unit(world_from_normal * glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
      for (int end : {0, 1}) {
        const glm::dvec3& w = s.weights[end];
        ends_m[side][end] = w.x * points_[s.corners.x].position_m + w.y * points_[s.corners.y].position_m +
                            w.z * points_[s.corners.z].position_m;
      }
    }
    two.apart_m = 0;
    for (int end : {0, 1}) {
      two.ends_m[end] = (ends_m[0][end] + ends_m[1][end]) * 0.5;
      two.apart_m = std::max(two.apart_m, glm::distance(ends_m[0][end], ends_m[1][end]));
    }
    two.across = across(two, 0);
  }
  for (Quad& quad : quads_) {
    const TwoFaces& two = cuts_[quad.cut];
    const auto direction = snorm(unit(glm::dmat3(object_from_world_) * across(two, quad.of)));
    for (int end : {0, 1}) {
      const glm::dvec3& w = two.sides[quad.of].weights[end];
      glm::dvec3 normal(0);
      for (int k = 0; k < 3; ++k) {
        const auto& n = vertices[quad.corners[k]].normal;
        normal += w[k] * glm::dvec3(n[0], n[1], n[2]);
      }
      quad.ends[end].shape.normal = snorm(unit(normal));
      quad.ends[end].across = direction;
    }
  }
}

void IntersectionStrips::collect(const mesh::Contour& contour, const View& view) {
  vertices_.clear();
  indices_.clear();
  runs_.clear();
  const glm::dmat3 camera_from_world = glm::mat3_cast(view.camera_from_world.rotation);
  const Eye eye{camera_from_world, glm::transpose(camera_from_world), view.camera_from_world.translation_m,
                glm::dvec2(view.camera.fx_px, view.camera.fy_px)};
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const glm::dvec3 position = camera_from_world * points_[p].position_m + eye.translation_m;
    const glm::dvec3 way = inset(eye.focal_px, position, camera_from_world * points_[p].outline_normal);
    drawn_points_[p] = {position + way, way};
  }
  for (std::size_t c = 0; c < cuts_.size(); ++c) {
    const TwoFaces& two = cuts_[c];
    const bool front[] = {contour.front[two.sides[0].face] != 0, contour.front[two.sides[1].face] != 0};
    placed_[c].seen = (front[0] || two.sides[0].two_sided) && (front[1] || two.sides[1].two_sided);
    if (placed_[c].seen) place(two, eye, !front[0], placed_[c]);
  }
  for (const Quad& quad : quads_) {
    const Placed& placed = placed_[quad.cut];
    if (placed.seen) emit(quad, placed, contour.front[cuts_[quad.cut].sides[quad.of].face] == 0);
  }
}

void IntersectionStrips::place(const TwoFaces& two, const Eye& eye, bool first_from_behind, Placed& placed) const {
  std::array<glm::dvec3, 2> normals;            // of the planes as they are drawn, in the camera's frame
  std::array<std::array<double, 2>, 2> offset;  // of the ends and then of the planes: along the normals
  for (int side : {0, 1}) {
    const Side& s = two.sides[side];
    const std::array<DrawnPoint, 3> corners{drawn_points_[s.corners.x], drawn_points_[s.corners.y],
                                            drawn_points_[s.corners.z]};
    for (const DrawnPoint& corner : corners) {
      if (!(corner.position_m.z > near_m)) {
        placed.seen = false;
        return;
      }
    }
    normals[side] =
        unit(glm::cross(corners[1].position_m - corners[0].position_m, corners[2].position_m - corners[0].position_m));
    for (int end : {0, 1}) {
      const glm::dvec3& w = s.weights[end];
      const glm::dvec3 way = w.x * corners[0].way_m + w.y * corners[1].way_m + w.z * corners[2].way_m;
      offset[end][side] = glm::dot(normals[side], way);
    }
  }
  const glm::dvec3 line = eye.camera_from_world * (two.ends_m[1] - two.ends_m[0]);
  const glm::dvec3 across = eye.camera_from_world * (first_from_behind ? -two.across : two.across);
  for (int end : {0, 1}) {
    const glm::dvec3 position = eye.camera_from_world * two.ends_m[end] + eye.translation_m;
    constexpr double most_apart_px = 0.5;
    if (two.apart_m * eye.focal_px.x > most_apart_px * position.z) {
      placed.seen = false;
      return;
    }
    const glm::dvec3 way = way_to_moved_line(normals, offset[end]);
    placed.ends[end] = glm::vec3(object_from_world_ * glm::dvec4(two.ends_m[end] + eye.world_from_camera * way, 1));
    // At right angles to the line in the picture, over the second face.
    const glm::dvec2 seen_line = seen_way_px(eye.focal_px, position, line);
    glm::dvec2 aside(-seen_line.y, seen_line.x);
    if (glm::dot(aside, seen_way_px(eye.focal_px, position, across)) < 0) aside = -aside;
    const double length = glm::length(aside);
    const double moved_px = length > 0 ? glm::dot(aside, seen_way_px(eye.focal_px, position, way)) / length : 0;
    // Faces that are nearly one plane may, drawn smaller, meet far away from where they end.
    constexpr double most_px = 1;
    if (!(std::abs(moved_px) < most_px)) {
      placed.seen = false;
      return;
    }
    const double first_reach = std::clamp(0.5 - moved_px, 0.0, 1.0);
    placed.reach[0][end] = static_cast<std::int16_t>(std::lround(first_reach * 32767));
    placed.reach[1][end] = static_cast<std::int16_t>(32767 - placed.reach[0][end]);
  }
}

void IntersectionStrips::emit(const Quad& quad, const Placed& placed, bool from_behind) {
  const auto base = static_cast<std::uint32_t>(vertices_.size());
  for (std::int16_t rim : {0, 32767}) {
    for (int end : {0, 1}) {
      BorderVertex v = quad.ends[end];
      v.shape.position = placed.ends[end];
      v.shape.outline_normal[3] = rim;
      // Of a two-sided face seen from behind, the other side is the outer one.
      for (int k = 0; from_behind && k < 3; ++k) {
        v.shape.normal[k] = static_cast<std::int16_t>(-v.shape.normal[k]);
        v.across[k] = static_cast<std::int16_t>(-v.across[k]);
      }
      v.across[3] = placed.reach[quad.of][end];
      vertices_.push_back(v);
    }
  }
  append_quad(quad.part, base, indices_, runs_);
}

}  // namespace rinkaku::passes
