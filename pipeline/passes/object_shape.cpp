#include "pipeline/passes/object_shape.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "mesh/bounds.h"
#include "mesh/intersections.h"

namespace rinkaku::passes {
namespace {

// Takes a position to (x Z, y Z, Z, Z), x and y in pixels of the pinhole picture. Composed in double, rounded once.
glm::mat4 pixels_from_object(const View& view, const glm::dmat4& world_from_object) {
  const CameraModel& camera = view.camera;
  const glm::dmat4 rows = glm::transpose(to_matrix(view.camera_from_world) * world_from_object);
  const glm::dvec4 depth = rows[2];
  return glm::mat4(glm::transpose(glm::dmat4(camera.fx_px * rows[0] + camera.cx_px * depth,
                                             camera.fy_px * rows[1] + camera.cy_px * depth, depth, depth)));
}

// What levels of detail must keep: uneven triangles, and those that cut each other, so that the line they meet in stays
// where it is.
// Which triangles levels of detail must keep as they are.
std::vector<std::uint8_t> kept(std::span<const std::uint8_t> uneven, std::span<const mesh::Cut> cuts,
                               const BorderStrips& borders, std::size_t triangles) {
  std::vector<std::uint8_t> mask(uneven.begin(), uneven.end());
  mask.resize(triangles);
  for (const mesh::Cut& cut : cuts) mask[cut.faces[0]] = mask[cut.faces[1]] = 1;
  borders.mark_triangles(mask);
  return mask;
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
  // Unlit, the two sides of a crease have one colour.
  borders_.emplace(mesh, topology, vertices_, world_from_object, !uneven.empty());
  const std::vector<mesh::Cut> cuts = mesh::intersections(topology);
  intersections_.emplace(mesh, topology, cuts, world_from_object);
  whole_.emplace(mesh, topology);
  levels_.emplace(mesh, kept(uneven, cuts, *borders_, mesh.triangles.size()));
  made_levels_.resize(levels_->count());
  triangles_ = mesh.triangles.size();
  if (levels_->count() == 0) return;
  outlook_.positions = mesh.positions;
  outlook_.welded = mesh.welded;
  outlook_.point_count = mesh.point_count;
  outlook_.materials = mesh.materials;
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
    out.outline_normal = snorm(push[mesh.welded[v]] * push_m_);
    out.uv = mesh.uvs.empty() ? glm::vec2(0) : mesh.uvs[v];
    out.colour = unorm(mesh.colours.empty() ? glm::vec4(1) : mesh.colours[v]);
  }
  for (const glm::vec3& p : topology.points) {
    x_.push_back(p.x);
    y_.push_back(p.y);
    z_.push_back(p.z);
  }
}

void ObjectShape::animate(const mesh::Mesh& mesh, mesh::Rig rig, const mesh::Playback& playback) {
  const mesh::Topology topology = mesh::topology(mesh);
  moving_.emplace(mesh, topology, std::move(rig), playback, world_from_object_);
  push_m_ = moving_->push().length_m();
  levels_.emplace(mesh::Mesh{});
  made_levels_.clear();
  strips_.emplace(mesh, topology, two_sided_, true);
  borders_->append_used(used_points_, used_positions_);
  for (std::uint32_t& used : used_points_) used = mesh.welded[used];
  intersections_->append_used(mesh.welded, used_points_);
  std::sort(used_points_.begin(), used_points_.end());
  used_points_.erase(std::unique(used_points_.begin(), used_points_.end()), used_points_.end());
  x_ = y_ = z_ = {};
  follow();
}

// Brings to where the mesh has moved what is kept of it, but for what each contour needs.
void ObjectShape::follow() {
  const mesh::Box& box = moving_->skin().box();
  centre_ = glm::dvec3(world_from_object_ * glm::dvec4(box.centre(), 1.0));
  whole_->move(moving_->faces(), moving_->points(), box);
  for (const std::uint32_t point : used_points_) moving_->settle(point, vertices_);
  for (const std::uint32_t vertex : used_positions_) moving_->place(vertex, vertices_);
  borders_->move(vertices_);
  intersections_->move(moving_->points(), moving_->skin().outline_normals(), vertices_);
}

void ObjectShape::settle(const mesh::Contour& contour) {
  if (asked_for_vertices_) {
    for (std::uint32_t p = 0; p < moving_->points().size(); ++p) moving_->settle(p, vertices_);
    return;
  }
  const std::span<const std::uint32_t> welded = moving_->welded();
  strips_->for_each_used(
      contour, [&](std::uint32_t v) { moving_->settle(welded[v], vertices_); },
      [&](std::uint32_t v) { moving_->place(v, vertices_); });
}

const Look& ObjectShape::look(const View& view, const PixelRect& picture) {
  look_ = {};
  if (moving_ && moving_->move_to(view.time_s)) follow();
  const glm::mat4 to_pixels = pixels_from_object(view, world_from_object_);
  find_bounds(to_pixels, picture);
  if (!look_.visible) return look_;
  const RigidTransform world_from_camera = inverse(view.camera_from_world);
  look_.distance_m = glm::length(centre_ - world_from_camera.translation_m);
  const glm::dvec3 eye = glm::dvec3(object_from_world_ * glm::dvec4(world_from_camera.translation_m, 1.0));
  mesh::ContourFinder* const level = finder_for(view);
  const bool whole = level == nullptr;
  const mesh::KnownFaces* const known = known_.faces ? known_.faces(eye) : nullptr;
  const mesh::Contour& contour = whole_->find(eye, {.front = whole, .edges = true}, known);
  if (whole) {
    list_front(contour, false);
  } else {
    list_front(level->find(eye, {.front = true, .edges = false}), true);
    // The level's error is of the kind of a mean, so allow for more.
    look_.overlap_px = 1.5f;
  }
  if (known_.cover) take_cover(view, eye);
  if (moving_) settle(contour);
  strips_->collect(contour, vertices_);
  look_.to_pixels = to_pixels;
  look_.contour_pieces = strips_->pieces();
  look_.hidden_contour_pieces = strips_->hidden_pieces();
  look_.front_faces = contour.front;
  look_.strip_vertices = strips_->vertices();
  look_.strip_indices = strips_->indices();
  look_.strip_runs = strips_->runs();
  if (asked_for_lines_) {
    if (moving_) lines_->find_factors(*strips_, moving_->skin().points(), moving_->skin().outline_normals());
    lines_->collect(*strips_, vertices_, to_pixels, view.camera);
    look_.line_vertices = lines_->vertices();
    look_.line_indices = lines_->indices();
    look_.line_push = lines_->largest_push();
  }
  borders_->collect(contour);
  look_.border_indices = borders_->indices();
  look_.border_runs = borders_->runs();
  intersections_->collect(contour, view);
  look_.intersection_vertices = intersections_->vertices();
  look_.intersection_indices = intersections_->indices();
  look_.intersection_runs = intersections_->runs();
  return look_;
}

void ObjectShape::ask_for_lines(const LineStyle& style) {
  asked_for_lines_ = true;
  lines_->style(style);
}

// Null for the whole mesh.
mesh::ContourFinder* ObjectShape::finder_for(const View& view) {
  // What changes in colour stays as it is and the contour is exact, so this shows only where the object hides itself.
  // There a coarser surface hides the inner side of a line behind it, so far that over flat parts, where the error of a
  // few places is several times the level's own, thin lines had gaps: with lines it may be half as wrong.
  const double most_px = asked_for_lines_ ? 0.5 : 1.0;
  if (look_.crosses_eye_plane) return nullptr;
  // The most that one of the mesh's units takes, along the axis that is stretched most.
  const double px_per_unit = view.camera.fx_px * largest_scale_ / look_.nearest_m;
  std::size_t level = 0;
  while (level < levels_->count() && levels_->most_error(level) * px_per_unit <= most_px) ++level;
  return level == 0 ? nullptr : level_finder(level - 1);
}

mesh::ContourFinder* ObjectShape::level_finder(std::size_t level) {
  // Where most is kept, a level only makes the feather reach further in.
  constexpr double most_left = 0.85;
  // What is opaque is drawn from both sides where it is seen nearly edge on: where simplifying has turned a triangle
  // over, a pixel of the body would be missing. What is behind hides it again, unless it can be seen through.
  const bool opaque =
      std::none_of(outlook_.materials.begin(), outlook_.materials.end(),
                   [](const mesh::Material& material) { return material.alpha == mesh::Material::Alpha::Blend; });
  const mesh::ContourOptions sides = opaque ? mesh::ContourOptions{.margin = 0.1} : mesh::ContourOptions{};
  MadeLevel& found = made_levels_[level];
  if (!found.made) {
    found.made = true;
    mesh::Level made = levels_->make(level);
    if (static_cast<double>(made.triangles.size()) > most_left * static_cast<double>(triangles_)) return nullptr;
    outlook_.triangles = std::move(made.triangles);
    outlook_.parts = std::move(made.parts);
    found.finder.emplace(outlook_, mesh::topology(outlook_), sides);
  }
  return found.finder ? &*found.finder : nullptr;
}

void ObjectShape::list_front(const mesh::Contour& found, bool split) {
  look_.front = found.front_indices;
  front_runs_.clear();
  for (std::uint32_t p = 0; p < found.front_parts.size(); ++p) {
    const mesh::IndexRange& range = found.front_parts[p];
    if (range.count == 0) continue;
    front_runs_.push_back({split ? p / 2 : p, range.first, range.count, split && p % 2 == 1});
  }
  look_.front_runs = front_runs_;
}

// What covers the same pixels, where it is less than what was found.
void ObjectShape::take_cover(const View& view, const glm::dvec3& eye) {
  if (view.camera.fx_px * largest_scale_ / look_.farthest_m < known_.least_px_per_unit) return;
  const std::span<const std::uint32_t> cover = known_.cover(eye);
  if (cover.empty() || cover.size() >= look_.front.size()) return;
  look_.front = cover;
  front_runs_.assign(1, {0, 0, static_cast<std::uint32_t>(cover.size()), false});
  look_.front_runs = front_runs_;
  look_.cull_back_faces = true;
  look_.overlap_px = 0;
}

void ObjectShape::find_bounds(const glm::mat4& to_pixels, const PixelRect& picture) {
  const glm::mat4 rows = glm::transpose(to_pixels);
  const glm::vec4 row_x = rows[0], row_y = rows[1], row_z = rows[2];
  const std::span<const glm::vec3> points = moving_ ? moving_->points() : std::span<const glm::vec3>();
  float left = 1e30f, right = -1e30f, top = 1e30f, bottom = -1e30f, nearest = 1e30f, farthest = -1e30f;
  const auto take = [&](float x, float y, float z) {
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
  };
  for (std::size_t i = 0; i < x_.size(); ++i) take(x_[i], y_[i], z_[i]);
  for (const glm::vec3& p : points) take(p.x, p.y, p.z);
  if (!(farthest > near_m)) return;  // behind the camera, or no point at all
  look_.nearest_m = nearest;
  look_.farthest_m = farthest;
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
