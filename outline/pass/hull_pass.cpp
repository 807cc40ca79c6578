#include "outline/pass/hull_pass.h"

#include <algorithm>

#include <glm/gtc/type_ptr.hpp>

#include "embedded/hull.frag.h"
#include "embedded/hull.vert.h"

namespace rinkaku::outline {

HullPass::HullPass(passes::DrawnObject& object, const HullOptions& options) : object_(object), look_(options.look) {
  passes::LineStyle style = options.style;
  style.width_px = look_.width_m > 0 ? 0 : look_.width_px, style.width_m = look_.width_m;
  style.least_px = look_.width_m > 0 ? look_.least_px : look_.width_px;
  style.most_px = look_.width_m > 0 ? look_.most_px : look_.width_px;
  if (options.lean > 0) style.longest_px = LineRoom::every_px;
  object_.ask_for_lines(style);
  const float largest_factor = object_.shape().largest_line_factor();
  if (options.lean > 0) room_.emplace(options.lean, largest_factor);
  const std::string_view vertex[] = {line_width_glsl(), embedded::hull_vert};
  const std::string_view fragment[] = {embedded::hull_frag};
  program_ = gl::Program("outline", {}, vertex, fragment);
  width_ = LineWidthUniforms(program_);
  clip_from_object_ = program_.uniform("clip_from_object");
  viewport_px_ = program_.uniform("viewport_px");
  soft_ = program_.uniform("soft");
  const GLuint name = program_.name();
  glProgramUniform1f(name, program_.uniform("largest_factor"), largest_factor);
  glProgramUniform1f(name, program_.uniform("most_push"), passes::LineVertex::most_push);
  glProgramUniform3fv(name, program_.uniform("colour"), 1, glm::value_ptr(look_.colour));
}

double HullPass::reach_px(const passes::View& view) const {
  const passes::Look& seen = object_.shape().last_look();
  const double widest = widest_px(look_, seen, view) * object_.shape().largest_line_factor();
  return (std::max(widest, 1.0) + 0.5) * seen.line_push + 0.5;
}

void HullPass::look_behind(const passes::DrawCall& call) {
  // In a mirror depth counts otherwise, and lines keep their width.
  has_looked_ = room_.has_value() && !call.view.mirror;
  if (has_looked_) room_->find(object_, look_, call);
}

void HullPass::draw_edges(const passes::DrawCall& call) {
  constexpr GLuint room = 2;  // the attribute
  glVertexAttrib1f(room, LineRoom::any_width_px);
  const GLsizei count = object_.bind_lines(has_looked_ ? room_->name() : 0);
  if (count == 0) return;
  glUseProgram(program_.name());
  width_.set(look_, call);
  glUniformMatrix4fv(clip_from_object_, 1, GL_FALSE, glm::value_ptr(call.clip_from_object));
  glUniform2f(viewport_px_, call.viewport_px.x, call.viewport_px.y);
  // Only what is opaque hides what is behind it: lines that cross keep no holes along their soft rims.
  for (const bool soft : {false, true}) {
    glUniform1i(soft_, soft ? 1 : 0);
    glDepthMask(soft ? GL_FALSE : GL_TRUE);
    glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, nullptr);
  }
}

}  // namespace rinkaku::outline
