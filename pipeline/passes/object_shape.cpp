#include "pipeline/passes/object_shape.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "mesh/bounds.h"
#include "mesh/levels.h"

namespace rinkaku::passes {
namespace {

std::array<std::int16_t, 4> snorm(const glm::vec3& v) {
  auto code = [](float f) { return static_cast<std::int16_t>(std::lround(std::clamp(f, -1.0f, 1.0f) * 32767.0f)); };
  return {code(v.x), code(v.y), code(v.z), 0};
}

std::array<std::uint8_t, 4> unorm(const glm::vec4& v) {
  auto code = [](float f) { return static_cast<std::uint8_t>(std::lround(std::clamp(f, 0.0f, 1.0f) * 255.0f)); };
  return {code(v.x), code(v.y), code(v.z), code(v.w)};
}

// Takes a position to (x Z, y Z, Z, Z), x and y in pixels of the pinhole picture. Composed in double, rounded once.
glm::mat4 pixels_from_object(const View& view, const glm::dmat4& world_from_object) {
  const CameraModel& camera = view.camera;
  const glm::dmat4 rows = glm::transpose(to_matrix(view.camera_from_world) * world_from_object);
  const glm::dvec4 depth = rows[2];
  return glm::mat4(glm::transpose(glm::dmat4(camera.fx_px * rows[0] + camera.cx_px * depth,
                                             camera.fy_px * rows[1] + camera.cy_px * depth, depth, depth)));
}

}  // namespace

ObjectShape::ObjectShape(const mesh::Mesh& mesh, const glm::dmat4& world_from_object,
                         std::span<const std::uint8_t> uneven)
    : world_from_object_(world_from_object),
      object_from_world_(glm::inverse(world_from_object)),
      world_from_normal_(glm::transpose(glm::inverse(glm::dmat3(world_from_object)))),
      mirrored_(glm::determinant(glm::dmat3(world_from_object)) < 0) {
  for (int axis = 0; axis < 3; ++axis) {
    largest_scale_ = std::max(largest_scale_, glm::length(glm::dvec3(world_from_object[axis])));
  }
  centre_ = glm::dvec3(world_from_object * glm::dvec4(mesh::bounding_box(mesh.positions).centre(), 1.0));
  const mesh::Topology topology = mesh::topology(mesh);
  for (std::uint8_t flag : topology.component_two_sided) two_sided_ = two_sided_ || flag != 0;
  for (const mesh::Part& part : mesh.parts) two_sided_ = two_sided_ || mesh.materials[part.material].two_sided;
  collect_vertices(mesh, topology);
  strips_.emplace(mesh, topology, two_sided_);
  lines_.emplace(mesh, topology, mirrored_);
  borders_.emplace(mesh, topology, vertices_, world_from_object);
  levels_.push_back({0, mesh::ContourFinder(mesh, topology), false});
  mesh::Mesh coarse = mesh;
  for (mesh::Level& level : mesh::levels(mesh, uneven)) {
    coarse.triangles = std::move(level.triangles);
    coarse.parts = std::move(level.parts);
    levels_.push_back({level.error, mesh::ContourFinder(coarse, mesh::topology(coarse)), true});
  }
}

void ObjectShape::collect_vertices(const mesh::Mesh& mesh, const mesh::Topology& topology) {
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
    ShapeVertex& out = vertices_[v];
    out.position = mesh.positions[v];
    out.normal = snorm(mesh.normals[v]);
    out.outline_normal = snorm(glm::vec3(push[mesh.welded[v]] * push_m_));
    out.uv = mesh.uvs.empty() ? glm::vec2(0) : mesh.uvs[v];
    out.colour = unorm(mesh.colours.empty() ? glm::vec4(1) : mesh.colours[v]);
  }
  for (const glm::vec3& p : topology.points) {
    x_.push_back(p.x);
    y_.push_back(p.y);
    z_.push_back(p.z);
  }
}

const Look& ObjectShape::look(const View& view, const PixelRect& picture) {
  look_ = {};
  const glm::mat4 to_pixels = pixels_from_object(view, world_from_object_);
  find_bounds(to_pixels, picture);
  if (!look_.visible) return look_;
  const RigidTransform world_from_camera = inverse(view.camera_from_world);
  look_.distance_m = glm::length(centre_ - world_from_camera.translation_m);
  const glm::dvec3 eye = glm::dvec3(object_from_world_ * glm::dvec4(world_from_camera.translation_m, 1.0));
  Level& level = level_for(view);
  const bool whole = &level == &levels_.front();
  const mesh::Contour& contour = levels_.front().finder.find(eye, {.front = whole, .edges = true});
  if (whole) {
    list_front(level, contour);
  } else {
    list_front(level, level.finder.find(eye, {.front = true, .edges = false}));
    // The level's error is of the kind of a mean, so allow for more.
    look_.overlap_px = 1.5f;
  }
  strips_->collect(contour, vertices_);
  look_.strip_vertices = strips_->vertices();
  look_.strip_indices = strips_->indices();
  look_.strip_runs = strips_->runs();
  if (asked_for_lines_) {
    lines_->collect(*strips_, vertices_, to_pixels, view.camera);
    look_.line_vertices = lines_->vertices();
    look_.line_indices = lines_->indices();
    look_.line_push = lines_->largest_push();
  }
  borders_->collect(contour);
  look_.border_indices = borders_->indices();
  look_.border_runs = borders_->runs();
  return look_;
}

void ObjectShape::ask_for_lines(const LineStyle& style) {
  asked_for_lines_ = true;
  lines_->style(style);
}

ObjectShape::Level& ObjectShape::level_for(const View& view) {
  // What changes in colour stays as it is and the contour is exact, so this shows only where the object hides itself.
  constexpr double most_px = 1.0;
  if (look_.crosses_eye_plane) return levels_.front();
  // The most that one of the mesh's units takes, along the axis that is stretched most.
  const double px_per_unit = view.camera.fx_px * largest_scale_ / look_.nearest_m;
  std::size_t level = 0;
  while (level + 1 < levels_.size() && levels_[level + 1].error * px_per_unit <= most_px) ++level;
  return levels_[level];
}

void ObjectShape::list_front(const Level& level, const mesh::Contour& found) {
  look_.front = found.front_indices;
  front_runs_.clear();
  for (std::uint32_t p = 0; p < found.front_parts.size(); ++p) {
    const mesh::IndexRange& range = found.front_parts[p];
    if (range.count == 0) continue;
    front_runs_.push_back({level.split ? p / 2 : p, range.first, range.count, level.split && p % 2 == 1});
  }
  look_.front_runs = front_runs_;
}

void ObjectShape::find_bounds(const glm::mat4& to_pixels, const PixelRect& picture) {
  const glm::mat4 rows = glm::transpose(to_pixels);
  const glm::vec4 row_x = rows[0], row_y = rows[1], row_z = rows[2];
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
  look_.nearest_m = nearest;
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

}  // namespace rinkaku::passes
