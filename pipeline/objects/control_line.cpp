#include "pipeline/objects/control_line.h"

#include <cmath>

#include <glm/matrix.hpp>

#include "outline/curvature.h"

namespace rinkaku::pipeline {
namespace {

std::vector<glm::vec3> controls(const ControlScene& control, const mesh::Topology& topology,
                                const glm::dmat4& world_from_object) {
  if (control.on_sphere > 0) {
    return outline::control_points_on_sphere(topology, control.on_sphere, control.distance);
  }
  if (control.points_m.empty()) return outline::control_points_along(topology, control.along, control.distance);
  const glm::dmat4 object_from_world = glm::inverse(world_from_object);
  std::vector<glm::vec3> points;
  for (const glm::dvec3& p : control.points_m) points.emplace_back(object_from_world * glm::dvec4(p, 1));
  return points;
}

}  // namespace

outline::ControlWidths control_widths(const OutlineScene& line, const mesh::Topology& topology,
                                      const glm::dmat4& world_from_object) {
  outline::ControlOptions options;
  options.features = line.control.features;
  options.exaggeration = line.exaggeration;
  options.smoothing = line.smoothing;
  using Distance = outline::ControlOptions::Distance;
  options.distance = line.control.lengths ? Distance::Lengths : Distance::Apart;
  // One of the mesh's units takes about so many metres.
  const double scale = std::cbrt(std::abs(glm::determinant(glm::dmat3(world_from_object))));
  options.reach = line.control.reach_m.value_or(0) / scale;
  const double k95 = outline::k95(outline::curvature(topology));
  return {topology, k95, controls(line.control, topology, world_from_object), options};
}

}  // namespace rinkaku::pipeline
