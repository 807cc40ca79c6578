#include "pipeline/passes/holdout/holdout_pass.h"

#include "embedded/holdout.frag.h"
#include "embedded/holdout.vert.h"

namespace rinkaku::passes {

HoldoutPass::HoldoutPass(DrawnObject& object) : object_(object), surface_(make(false)), feather_(make(true)) {}

HoldoutPass::Variant HoldoutPass::make(bool feather) {
  std::vector<std::string_view> defines;
  if (feather) defines.emplace_back("FEATHER");
  const std::string_view vertex[] = {screen_offset_glsl(), embedded::holdout_vert};
  const std::string_view fragment[] = {embedded::holdout_frag};
  Variant v;
  v.program = gl::Program("holdout", defines, vertex, fragment);
  v.offset = OffsetUniforms(v.program);
  v.offset_px = v.program.uniform("offset_px");
  v.edge_coverage = v.program.uniform("edge_coverage");
  return v;
}

void HoldoutPass::use(const Variant& variant, const DrawCall& call, float overlap_px) {
  glUseProgram(variant.program.name());
  variant.offset.set(call);
  glUniform2f(variant.offset_px, -feather_px - overlap_px, feather_px);
  glUniform1f(variant.edge_coverage, 1 + overlap_px);
}

void HoldoutPass::draw_surface(const DrawCall& call) {
  use(surface_, call, 0);
  for (const Run& run : object_.bind_front()) draw_run(run);
}

void HoldoutPass::draw_edges(const DrawCall& call) {
  use(feather_, call, object_.shape().last_look().overlap_px);
  glBlendFunc(GL_ZERO, GL_ONE_MINUS_SRC_ALPHA);
  for (const Run& run : object_.bind_contour()) draw_run(run);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

}  // namespace rinkaku::passes
