#include "outline/pass/line_room.h"

#include <glm/gtc/type_ptr.hpp>

#include "embedded/line_room.vert.h"

namespace rinkaku::outline {

LineRoom::LineRoom(float lean, float largest_factor) {
  const std::string_view text[] = {line_width_glsl(), embedded::line_room_vert};
  program_ = gl::Program::vertices("line_room", {}, text);
  width_ = LineWidthUniforms(program_);
  clip_from_object_ = program_.uniform("clip_from_object");
  viewport_px_ = program_.uniform("viewport_px");
  near_m_ = program_.uniform("near_m");
  empty_depth_ = program_.uniform("empty_depth");
  focal_px_ = program_.uniform("focal_px");
  const GLuint name = program_.name();
  glProgramUniform1i(name, program_.uniform("depths"), 0);
  glProgramUniform1f(name, program_.uniform("lean"), lean);
  glProgramUniform1f(name, program_.uniform("largest_factor"), largest_factor);
  glProgramUniform1f(name, program_.uniform("most_push"), passes::LineVertex::most_push);
}

void LineRoom::find(passes::DrawnObject& object, const LineLook& look, const passes::DrawCall& call) {
  const GLsizei count = object.line_vertices();
  if (object.bind_lines() == 0) return;
  if (count > holds_) {
    holds_ = count + count / 2;
    room_ = gl::StorageBuffer(static_cast<std::size_t>(holds_) * sizeof(float));
  }
  glUseProgram(program_.name());
  width_.set(look, call);
  glUniformMatrix4fv(clip_from_object_, 1, GL_FALSE, glm::value_ptr(call.clip_from_object));
  glUniform2f(viewport_px_, call.viewport_px.x, call.viewport_px.y);
  glUniform1f(near_m_, call.near_m);
  glUniform1f(empty_depth_, call.empty_depth);
  glUniform1f(focal_px_, static_cast<float>(call.view.camera.fx_px));
  glTextureBarrier();  // the depths are still the target's
  glBindTextureUnit(0, call.depths);
  glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, room_.name());
  glEnable(GL_RASTERIZER_DISCARD);
  glBeginTransformFeedback(GL_POINTS);
  glDrawArrays(GL_POINTS, 0, count);
  glEndTransformFeedback();
  glDisable(GL_RASTERIZER_DISCARD);
  glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
  glBindTextureUnit(0, 0);
}

}  // namespace rinkaku::outline
