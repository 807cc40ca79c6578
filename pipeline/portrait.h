#pragma once

#include <optional>

#include <glm/vec3.hpp>

#include "mesh/mesh.h"
#include "pipeline/frame/frame.h"
#include "pipeline/objects/lone_mesh.h"
#include "pipeline/scene/outline.h"

namespace rinkaku::pipeline {

/// An even line of two pixels.
OutlineScene thin_line();

struct PortraitOptions {
  int width_px = 1024;
  int height_px = 1024;
  char up = 'y';          ///< the mesh's up axis
  double turn_deg = 35;   ///< to the side of the front
  double raise_deg = 20;  ///< above the ground
  double margin = 0.06;   ///< of the picture, left free at each side
  std::optional<OutlineScene> outline = thin_line();
  LoneMotion motion{};  ///< of which the moment `time_s` is shown, after some frames of 1/24 s before it
  double time_s = 0;
  glm::vec3 background{0.88f, 0.88f, 0.87f};  ///< sRGB-encoded
};

/// Draws one mesh by itself, toon-shaded and outlined, from three-quarter front and as large as the picture takes it.
///
/// Returns a frame of 8-bit RGBA, opaque, sRGB. Makes a GL context of its own for the time. Throws Error (Runtime)
/// where there is no OpenGL 4.5, Error (Input) for a mesh without size.
Frame portrait(const mesh::Mesh& mesh, const PortraitOptions& options = {});

}  // namespace rinkaku::pipeline
