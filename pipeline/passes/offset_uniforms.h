#pragma once

#include <string_view>

#include "pipeline/gl/program.h"
#include "pipeline/passes/pass.h"

namespace rinkaku::passes {

/// GLSL of screen_offset.glsl: pushes vertices across the screen. For vertex shaders of passes, together with
/// OffsetUniforms. Vertex attributes: 0 position, 1 normal, 2 outline normal (w: rim of an edge's quad), 3 uv, 4
/// colour, 5 the direction across a border.
std::string_view screen_offset_glsl();

/// The uniforms that screen_offset.glsl declares.
class OffsetUniforms {
 public:
  OffsetUniforms() = default;
  explicit OffsetUniforms(const gl::Program& program);
  void set(const DrawCall& call) const;

 private:
  GLint clip_from_object_ = -1;
  GLint viewport_px_ = -1;
  GLint focal_px_ = -1;
};

}  // namespace rinkaku::passes
