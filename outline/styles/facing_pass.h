#pragma once

#include <glm/vec3.hpp>

#include "pipeline/gl/program.h"
#include "pipeline/passes/offset_uniforms.h"
#include "pipeline/passes/pass.h"

namespace rinkaku::outline {

struct FacingOptions {
  float threshold = 0.3f;                 ///< of the cosine between normal and line of sight, 0 to 1
  glm::vec3 colour{0.07f, 0.05f, 0.09f};  ///< sRGB-encoded
};

/// Line is what of a surface stands nearly on edge: |N . V| below a threshold (Gooch, Sloan, Gooch, Shirley and
/// Riesenfeld, "Interactive technical illustration", 1999).
///
/// Its width follows from the surface: broad where it turns away gently, none at hard edges, and a flat face seen at a
/// grazing angle is line as a whole; that is the method, and what other methods are there to avoid. The border of the
/// line is smoothed over a pixel. It comes after
/// the body in an object's passes.
class FacingPass : public passes::ObjectPass {
 public:
  /// `object` must outlive the pass.
  FacingPass(passes::DrawnObject& object, const FacingOptions& options);

  const char* name() const override { return "facing"; }
  bool draws_lines() const override { return true; }
  double reach_px(const passes::View&) const override { return 1; }
  void draw_surface(const passes::DrawCall& call) override;
  void draw_edges(const passes::DrawCall& call) override;

 private:
  void draw(const passes::DrawCall& call, bool feather);

  passes::DrawnObject& object_;
  gl::Program program_;
  passes::OffsetUniforms offset_;
  GLint camera_from_object_ = -1, camera_from_normal_ = -1, offset_px_ = -1, edge_coverage_ = -1, feather_ = -1;
};

}  // namespace rinkaku::outline
