#include "pipeline/portrait.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include "mesh/bounds.h"
#include "mesh/moving_mesh.h"
#include "mesh/topology.h"
#include "pipeline/frame/error.h"
#include "pipeline/gl/context.h"
#include "pipeline/objects/placement.h"
#include "pipeline/passes/composite/straight_alpha.h"

namespace rinkaku::pipeline {
namespace {

// The mesh stands in a ball of radius 1 m around the world's origin, which is seen from four times as far.
constexpr double kDistance_m = 4;

glm::dmat4 place_in_unit_ball(const mesh::Mesh& mesh, char up) {
  const double radius = mesh::bounding_sphere(mesh.positions).radius;
  if (!(radius > 0)) throw input_error("", "the mesh has no size", "check its positions");
  ObjectScene object;
  object.scale = glm::dvec3(1 / radius);
  const mesh::Box box = mesh::bounding_box(mesh.positions);
  const glm::dmat4 standing = world_from_object(object, box, up);
  object.position_m = -glm::dvec3(standing * glm::dvec4(box.centre(), 1));
  return world_from_object(object, box, up);
}

RigidTransform camera_from_world(const PortraitOptions& options) {
  const double turn = glm::radians(options.turn_deg), raise = glm::radians(options.raise_deg);
  const glm::dvec3 eye =
      kDistance_m * glm::dvec3(std::sin(turn) * std::cos(raise), -std::cos(turn) * std::cos(raise), std::sin(raise));
  const glm::dvec3 z = -glm::normalize(eye), x = glm::normalize(glm::cross(z, glm::dvec3(0, 0, 1)));
  return inverse(RigidTransform{glm::quat_cast(glm::dmat3(x, glm::cross(z, x), z)), eye});
}

// The focal length and the picture's place for which the mesh's own rectangle fills the picture up to the margins.
CameraModel fitting_camera(std::span<const glm::vec3> positions, const glm::dmat4& camera_from_object,
                           const PortraitOptions& options) {
  glm::dvec2 low(std::numeric_limits<double>::max()), high(-low);
  for (const glm::vec3& position : positions) {
    const glm::dvec3 p = glm::dvec3(camera_from_object * glm::dvec4(position, 1));
    const glm::dvec2 seen(p.x / p.z, p.y / p.z);
    low = glm::min(low, seen), high = glm::max(high, seen);
  }
  CameraModel camera;
  camera.width_px = options.width_px, camera.height_px = options.height_px;
  const double free = 1 - 2 * options.margin;
  // One of the two sizes may be 0, for a flat mesh seen edge-on.
  const glm::dvec2 size = glm::max(high - low, glm::dvec2(1e-6));
  camera.fx_px = camera.fy_px = std::min(free * options.width_px / size.x, free * options.height_px / size.y);
  const glm::dvec2 middle = (low + high) / 2.0;
  camera.cx_px = (options.width_px - 1) / 2.0 - camera.fx_px * middle.x;
  camera.cy_px = (options.height_px - 1) / 2.0 - camera.fy_px * middle.y;
  return camera;
}

// Where the mesh is at the moment that is shown.
std::vector<glm::vec3> shown_positions(const mesh::Mesh& mesh, const PortraitOptions& options) {
  if (options.motion.rig == nullptr) return mesh.positions;
  mesh::MovingMesh moving(mesh, mesh::topology(mesh), *options.motion.rig, options.motion.playback);
  moving.move_to(options.time_s);
  return {moving.skin().points().begin(), moving.skin().points().end()};
}

Frame laid_over(const passes::Layer& layer, const PortraitOptions& options) {
  Frame frame = FramePool().allocate(passes::rgba_format(options.width_px, options.height_px, {1, 1}));
  const glm::vec3 ground = options.background * 255.0f;
  const Plane& plane = frame.planes[0];
  for (int y = 0; y < options.height_px; ++y) {
    std::uint8_t* out = plane.data + y * plane.stride_bytes;
    for (int x = 0; x < options.width_px; ++x, out += 4) {
      const int lx = x - layer.rect.x_px, ly = y - layer.rect.y_px;
      const bool inside = lx >= 0 && ly >= 0 && lx < layer.rect.width_px && ly < layer.rect.height_px;
      static constexpr std::uint8_t nothing[4] = {};
      const std::uint8_t* in =
          inside ? layer.rgba.data() + (static_cast<std::size_t>(ly) * layer.rect.width_px + lx) * 4 : nothing;
      const float through = static_cast<float>(255 - in[3]) / 255.0f;
      for (int c = 0; c < 3; ++c) {
        out[c] = static_cast<std::uint8_t>(std::clamp(std::lround(in[c] + through * ground[c]), 0l, 255l));
      }
      out[3] = 255;
    }
  }
  return frame;
}

}  // namespace

OutlineScene thin_line() {
  OutlineScene line;
  line.width_px = 2;
  return line;
}

Frame portrait(const mesh::Mesh& mesh, const PortraitOptions& options) {
  const glm::dmat4 world_from_mesh = place_in_unit_ball(mesh, options.up);
  passes::View view;
  view.camera_from_world = camera_from_world(options);
  const std::vector<glm::vec3> positions = shown_positions(mesh, options);
  view.camera = fitting_camera(positions, to_matrix(view.camera_from_world) * world_from_mesh, options);

  const std::unique_ptr<gl::Context> context = gl::Context::headless();
  passes::Layer layer;
  {
    passes::ToonOptions toon;
    toon.shade_colour = {0.80f, 0.79f, 0.86f};
    toon.light = {-0.2f, -0.7f, 0.8f};
    const auto renderer = lone_mesh(mesh, world_from_mesh, toon, options.outline,
                                    {0, 0, options.width_px, options.height_px}, options.motion);
    // Strokes stay where they were in the frames before, so there have to be some.
    for (int before = options.motion.rig != nullptr ? 3 : 0; before >= 0; --before) {
      view.time_s = options.time_s - before / 24.0;
      renderer->draw(view, layer);
    }
  }
  return laid_over(layer, options);
}

}  // namespace rinkaku::pipeline
