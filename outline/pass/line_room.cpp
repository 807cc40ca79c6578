#include "outline/pass/line_room.h"

#include <algorithm>
#include <cstdint>

#include <glm/gtc/type_ptr.hpp>

#include "embedded/line_room.comp.h"

namespace rinkaku::outline {
namespace {

constexpr std::size_t kGroup = 64;          // as the shader has it
constexpr std::size_t kMostGroups = 65535;  // that every driver takes in a row

static_assert(sizeof(passes::LineVertex) == 5 * sizeof(std::uint32_t));  // as it reads them

}  // namespace

LineRoom::LineRoom(float lean, float largest_factor) {
  const std::string_view text[] = {line_width_glsl(), embedded::line_room_comp};
  program_ = gl::Program::compute("line_room", {}, text);
  width_ = LineWidthUniforms(program_);
  vertex_count_ = program_.uniform("vertex_count");
  clip_from_object_ = program_.uniform("clip_from_object");
  viewport_px_ = program_.uniform("viewport_px");
  near_m_ = program_.uniform("near_m");
  focal_px_ = program_.uniform("focal_px");
  const GLuint name = program_.name();
  glProgramUniform1i(name, program_.uniform("depths"), 0);
  glProgramUniform1f(name, program_.uniform("lean"), lean);
  glProgramUniform1f(name, program_.uniform("largest_factor"), largest_factor);
  glProgramUniform1f(name, program_.uniform("most_push"), passes::LineVertex::most_push);
}

void LineRoom::find(const passes::DrawnObject& object, const LineLook& look, const passes::DrawCall& call) {
  const std::size_t count = object.shape().last_look().line_vertices.size();
  if (count == 0) return;
  if (count > holds_) {
    holds_ = count + count / 2;
    room_ = gl::StorageBuffer(holds_ * sizeof(float));
  }
  glUseProgram(program_.name());
  width_.set(look, call);
  glUniform1ui(vertex_count_, static_cast<GLuint>(count));
  glUniformMatrix4fv(clip_from_object_, 1, GL_FALSE, glm::value_ptr(call.clip_from_object));
  glUniform2f(viewport_px_, call.viewport_px.x, call.viewport_px.y);
  glUniform1f(near_m_, call.near_m);
  glUniform1f(focal_px_, static_cast<float>(call.view.camera.fx_px));
  glBindTextureUnit(0, call.depths);
  const GLuint buffers[] = {object.line_buffer(), room_.name()};
  glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 0, 2, buffers);
  // What was drawn before still reads what is written now.
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  const std::size_t groups = (count + kGroup - 1) / kGroup;
  glDispatchCompute(static_cast<GLuint>(std::min(groups, kMostGroups)),
                    static_cast<GLuint>((groups + kMostGroups - 1) / kMostGroups), 1);
  glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
}

}  // namespace rinkaku::outline
