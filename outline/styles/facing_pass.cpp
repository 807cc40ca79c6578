#include "outline/styles/facing_pass.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "embedded/facing.frag.h"
#include "embedded/facing.vert.h"

namespace rinkaku::outline {

FacingPass::FacingPass(passes::DrawnObject& object, const FacingOptions& options) : object_(object) {
  const std::string_view vertex[] = {passes::screen_offset_glsl(), embedded::facing_vert};
  const std::string_view fragment[] = {embedded::facing_frag};
  program_ = gl::Program("facing", {}, vertex, fragment);
  offset_ = passes::OffsetUniforms(program_);
  camera_from_object_ = program_.uniform("camera_from_object");
  camera_from_normal_ = program_.uniform("camera_from_normal");
  offset_px_ = program_.uniform("offset_px");
  edge_coverage_ = program_.uniform("edge_coverage");
  feather_ = program_.uniform("feather");
  glProgramUniform1f(program_.name(), program_.uniform("threshold"), options.threshold);
  glProgramUniform3fv(program_.name(), program_.uniform("colour"), 1, glm::value_ptr(options.colour));
}

void FacingPass::draw_surface(const passes::DrawCall& call) {
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  draw(call, false);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

void FacingPass::draw_edges(const passes::DrawCall& call) {
  glDepthMask(GL_TRUE);
  draw(call, true);
  glDepthMask(GL_FALSE);
}

void FacingPass::draw(const passes::DrawCall& call, bool feather) {
  const passes::ObjectShape& shape = object_.shape();
  const glm::dmat4 camera_from_world = to_matrix(call.view.camera_from_world);
  const glm::mat4 camera_from_object(camera_from_world * shape.world_from_object());
  const glm::mat3 camera_from_normal = glm::mat3(glm::dmat3(camera_from_world)) * shape.world_from_normal();
  const float overlap_px = feather ? shape.last_look().overlap_px : 0;
  const std::span<const passes::Run> runs = feather ? object_.bind_contour() : object_.bind_front();
  glUseProgram(program_.name());
  offset_.set(call);
  glUniformMatrix4fv(camera_from_object_, 1, GL_FALSE, glm::value_ptr(camera_from_object));
  glUniformMatrix3fv(camera_from_normal_, 1, GL_FALSE, glm::value_ptr(camera_from_normal));
  glUniform1i(feather_, feather ? 1 : 0);
  glUniform2f(offset_px_, -passes::feather_px - overlap_px, passes::feather_px);
  glUniform1f(edge_coverage_, 1 + overlap_px);
  for (const passes::Run& run : runs) passes::draw_run(run);
}

}  // namespace rinkaku::outline
