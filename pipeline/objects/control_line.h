#pragma once

#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "mesh/topology.h"
#include "outline/control_points.h"
#include "pipeline/scene/outline.h"

namespace rinkaku::pipeline {

/// The widths of a line whose scene has the method "control", of a mesh that stands so.
outline::ControlWidths control_widths(const OutlineScene& line, const mesh::Topology& topology,
                                      const glm::dmat4& world_from_object);

}  // namespace rinkaku::pipeline
