#pragma once

#include <utility>

#include "mesh/assemble.h"
#include "mesh/topology.h"
#include "outline/fluffy/frame.h"
#include "tests/mesh/shapes.h"

// Fluffy frames of simple shapes.
namespace rinkaku::test {

inline fluffy::Frame frame_of(mesh::Soup soup, const fluffy::FrameOptions& options = {},
                              const glm::dmat3& world_from_object = glm::dmat3(1)) {
  const mesh::Mesh mesh = mesh::assemble(std::move(soup), 60).mesh;
  return fluffy::make_frame(mesh, mesh::topology(mesh), world_from_object, options, "scene");
}

}  // namespace rinkaku::test
