#include "outline/pass/hull_pass.h"

#include <algorithm>

#include <glm/gtc/type_ptr.hpp>

#include "embedded/hull.frag.h"
#include "embedded/hull.vert.h"

namespace rinkaku::outline {

HullPass::HullPass(passes::DrawnObject& object, const HullOptions& options) : object_(object), options_(options) {
  const std::string_view vertex[] = {passes::screen_offset_glsl(), embedded::hull_vert};
  const std::string_view fragment[] = {embedded::hull_frag};
  program_ = gl::Program("outline", {}, vertex, fragment);
  offset_ = passes::OffsetUniforms(program_);
  offset_px_ = program_.uniform("offset_px");
  breadth_px_ = program_.uniform("breadth_px");
  glProgramUniform1f(program_.name(), program_.uniform("strength"), std::min(options.width_px, 1.0f));
  glProgramUniform3fv(program_.name(), program_.uniform("colour"), 1, glm::value_ptr(options.colour));
}

void HullPass::draw_edges(const passes::DrawCall& call) {
  // From under the body's own feather to half a pixel past the line's edge. A line thinner than a pixel keeps a pixel's
  // width and is as faint as it is thin.
  const float width_px = std::max(options_.width_px, 1.0f);
  constexpr float under_px = -0.5f;
  const float reach_px = width_px + 0.5f;
  glUseProgram(program_.name());
  offset_.set(call);
  glUniform2f(offset_px_, under_px, reach_px);
  glUniform1f(breadth_px_, reach_px - under_px);
  glDepthMask(GL_TRUE);
  for (const passes::Run& run : object_.bind_contour()) passes::draw_run(run);
  glDepthMask(GL_FALSE);
}

}  // namespace rinkaku::outline
