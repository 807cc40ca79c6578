#include "outline/pass/hull_pass.h"

#include <algorithm>

#include <glm/gtc/type_ptr.hpp>

#include "embedded/hull.frag.h"
#include "embedded/hull.vert.h"

namespace rinkaku::outline {
namespace {

// What is added to the base line leans back by so many pixels a pixel.
constexpr float kLeanBack = 3;

}  // namespace

HullPass::HullPass(passes::DrawnObject& object, const HullOptions& options) : object_(object), options_(options) {
  if (options_.width_m <= 0) options_.least_px = options_.most_px = options_.width_px;
  passes::LineStyle& style = options_.style;
  style.width_px = options_.width_m > 0 ? 0 : options_.width_px, style.width_m = options_.width_m;
  style.least_px = options_.least_px, style.most_px = options_.most_px;
  object_.ask_for_lines(style);
  style.factors = {}, style.most_added_m = {};
  const std::string_view vertex[] = {embedded::hull_vert};
  const std::string_view fragment[] = {embedded::hull_frag};
  program_ = gl::Program("outline", {}, vertex, fragment);
  clip_from_object_ = program_.uniform("clip_from_object");
  viewport_px_ = program_.uniform("viewport_px");
  width_px_ = program_.uniform("width_px");
  soft_ = program_.uniform("soft");
  beyond_ = program_.uniform("beyond");
  back_ = program_.uniform("back");
  const GLuint name = program_.name();
  glProgramUniform2f(name, program_.uniform("width_limits_px"), options_.least_px, options_.most_px);
  glProgramUniform1f(name, program_.uniform("largest_factor"), object_.shape().largest_line_factor());
  glProgramUniform1f(name, program_.uniform("most_push"), passes::LineVertex::most_push);
  glProgramUniform3fv(name, program_.uniform("colour"), 1, glm::value_ptr(options.colour));
}

double HullPass::reach_px(const passes::View& view) const {
  const passes::Look& look = object_.shape().last_look();
  double widest_px = options_.most_px;
  if (options_.width_m > 0 && !look.crosses_eye_plane) {
    const double nearest_px = view.camera.fx_px * options_.width_m / look.nearest_m;
    widest_px = std::clamp<double>(nearest_px, options_.least_px, options_.most_px);
  }
  widest_px *= object_.shape().largest_line_factor();
  return (std::max(widest_px, 1.0) + 0.5) * look.line_push + 0.5;
}

void HullPass::draw_edges(const passes::DrawCall& call) {
  const GLsizei count = object_.bind_lines();
  if (count == 0) return;
  glUseProgram(program_.name());
  glUniformMatrix4fv(clip_from_object_, 1, GL_FALSE, glm::value_ptr(call.clip_from_object));
  glUniform2f(viewport_px_, call.viewport_px.x, call.viewport_px.y);
  const bool metres = options_.width_m > 0;
  glUniform2f(width_px_, metres ? 0 : options_.width_px,
              metres ? static_cast<float>(call.view.camera.fx_px) * options_.width_m : 0);
  glUniform1f(back_, kLeanBack / static_cast<float>(call.view.camera.fx_px));
  // The base line first, as it is the nearer.
  for (const bool beyond : {false, true}) {
    if (beyond && object_.shape().largest_line_factor() <= 1) break;
    glUniform1i(beyond_, beyond ? 1 : 0);
    // Only what is opaque hides what is behind it: lines that cross keep no holes along their soft rims.
    for (const bool soft : {false, true}) {
      glUniform1i(soft_, soft ? 1 : 0);
      glDepthMask(soft ? GL_FALSE : GL_TRUE);
      glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, nullptr);
    }
  }
}

}  // namespace rinkaku::outline
