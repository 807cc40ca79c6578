#include "pipeline/passes/offset_uniforms.h"

#include <glm/gtc/type_ptr.hpp>

#include "embedded/screen_offset.glsl.h"

namespace rinkaku::passes {

std::string_view screen_offset_glsl() { return embedded::screen_offset_glsl; }

OffsetUniforms::OffsetUniforms(const gl::Program& program)
    : clip_from_object_(program.uniform("clip_from_object")),
      viewport_px_(program.uniform("viewport_px")),
      focal_px_(program.uniform("focal_px")) {}

void OffsetUniforms::set(const DrawCall& call) const {
  glUniformMatrix4fv(clip_from_object_, 1, GL_FALSE, glm::value_ptr(call.clip_from_object));
  glUniform2f(viewport_px_, call.viewport_px.x, call.viewport_px.y);
  glUniform1f(focal_px_, call.focal_px);
}

}  // namespace rinkaku::passes
