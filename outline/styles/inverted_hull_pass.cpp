#include "outline/styles/inverted_hull_pass.h"

#include <algorithm>

#include <glm/gtc/type_ptr.hpp>

#include "embedded/inverted_hull.frag.h"
#include "embedded/inverted_hull.vert.h"

namespace rinkaku::outline {

InvertedHullPass::InvertedHullPass(passes::DrawnObject& object, const mesh::Mesh& mesh, const LineLook& look)
    : object_(object),
      look_(look),
      triangles_(std::as_bytes(std::span(mesh.triangles))),
      index_count_(static_cast<GLsizei>(3 * mesh.triangles.size())) {
  const std::string_view vertex[] = {line_width_glsl(), embedded::inverted_hull_vert};
  const std::string_view fragment[] = {embedded::inverted_hull_frag};
  program_ = gl::Program("inverted hull", {}, vertex, fragment);
  width_ = LineWidthUniforms(program_);
  clip_from_object_ = program_.uniform("clip_from_object");
  focal_px_ = program_.uniform("focal_px");
  soft_ = program_.uniform("soft");
  glProgramUniform3fv(program_.name(), program_.uniform("colour"), 1, glm::value_ptr(look.colour));
}

double InvertedHullPass::reach_px(const passes::View& view) const {
  return std::max(widest_px(look_, object_.shape().last_look(), view), 1.0) + 1;
}

void InvertedHullPass::use(const passes::DrawCall& call, bool soft) const {
  glUseProgram(program_.name());
  width_.set(look_, call);
  glUniformMatrix4fv(clip_from_object_, 1, GL_FALSE, glm::value_ptr(call.clip_from_object));
  glUniform1f(focal_px_, call.focal_px);
  glUniform1i(soft_, soft ? 1 : 0);
}

void InvertedHullPass::draw_surface(const passes::DrawCall& call) {
  object_.bind_whole(triangles_);
  use(call, false);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_FRONT);
  glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
  glDisable(GL_CULL_FACE);
}

void InvertedHullPass::draw_edges(const passes::DrawCall& call) {
  const std::span<const passes::Run> runs = object_.bind_contour();
  use(call, true);
  for (const passes::Run& run : runs) passes::draw_run(run);
}

}  // namespace rinkaku::outline
